"""`python -m vexture` is the program `vexture`, also where its folder is not on the PATH."""

from vexture.cli.start import main

if __name__ == "__main__":
    main()
