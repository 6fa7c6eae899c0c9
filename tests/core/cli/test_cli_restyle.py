"""The command `restyle`."""

from test_cli import SVG, run

import vexture

LOGO = SVG.format(
    '<rect width="10" height="10" fill="#00f"/><path id="word" d="M2 2h6v4h-6z" fill="white"/>'
    '<path d="M2 5h6v4h-6z" fill="red" fill-opacity="0.5"/>'
)


def test_elements_are_named_and_get_other_colours(tmp_path):
    logo, plain, blue = tmp_path / "logo.svg", tmp_path / "plain.ktx2", tmp_path / "blue.ktx2"
    logo.write_text(LOGO)
    assert run("convert", logo, "-o", plain, "--split", "faces", "--restyle").exit_code == 0
    assert "elements 1 (word)" in run("info", plain).stdout
    result = run("restyle", plain, "word=rgb(0 0 255 / 1)", "-o", blue)
    assert (result.exit_code, result.stdout[-7:]) == (0, " bytes\n")
    assert vexture.load(blue).render(10)[3, 4].tolist() == [0, 0, 1, 1]
    for arguments, says in (
        (("wrd=red", "-o", blue), "no element 'wrd'; near names are 'word'; there are 1"),
        (("word", "-o", blue), "'word' names no colour; give NAME=COLOUR"),
        (("word=red", "-o", tmp_path / "a.png"), "textures are KTX2 files; name one that ends in .ktx2"),
        (("word=#f008", "-o", blue), "'word' gets the opacity 0.533333, but the texture does not have what it hides"),
    ):
        result = run("restyle", plain, *arguments)
        assert result.exit_code == 1
        assert says in result.stderr
        assert len(result.stderr.splitlines()) == 1
    folder = tmp_path / "other"
    folder.mkdir()
    said = run("restyle", blue, "word=red", "-o", folder).stdout
    assert said.startswith(f"{folder / blue.name}: 1 element in other ")
    assert [file.name for file in folder.iterdir()] == [blue.name], "not the drawing's name, which is in the texture"
    before = blue.read_bytes()
    result = run("restyle", blue, "word=red", "-o", tmp_path)
    assert f"--output {tmp_path}: it holds {blue.name} itself; name a file, or another folder" in result.stderr
    assert (blue.read_bytes(), result.exit_code) == (before, 1)
    result = run("convert", logo, "-o", plain, "--restyle", "--silhouette")
    assert "`restyle`" not in result.stderr
    assert "--restyle is for a drawing in its colours, and a silhouette has none; leave it out" in result.stderr
