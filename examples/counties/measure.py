"""Measure what new colours for all counties cost: `python examples/counties/measure.py`, after `make counties`.

Prints milliseconds, of 200 frames in headless Chromium the means of the middle half, as its clock is coarse: of
`setPaints` for all counties and for one, and of sending the changed rows of the texture and, to compare, all of it,
until the graphics card or Mesa has them.
"""

import sys
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "packages" / "vexture-evidence" / "benchmarks"))

from chromium import chromium  # noqa: E402 - the browser of the benchmarks

PAGE: Final = ROOT / "demo" / "counties" / "index.html"

MEASURE: Final = """async () => {
    const {texture, renderer, recolor, state} = counties;
    renderer.setAnimationLoop(null);
    const {texels} = texture.textures;
    const gl = renderer.getContext();
    const settle = () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    const send = () => { renderer.initTexture(texels); settle(); };
    const ids = texture.roots[0].style.elements.map(({name}) => name);
    const steps = {
        'all counties': () => { state.seconds += 1 / 60; recolor(); },
        'changed rows': send,
        'one county': () => texture.setPaints(new Map([[ids[0], [Math.random(), 0, 0, 1]]])),
        'whole texture': () => { texels.clearUpdateRanges(); texels.needsUpdate = true; send(); },
    };
    const spent = Object.fromEntries(Object.keys(steps).map(name => [name, []]));
    for (let frame = 0; frame < 200; frame++) {
        for (const [name, step] of Object.entries(steps)) {
            const begun = performance.now();
            step();
            spent[name].push(performance.now() - begun);
        }
    }
    const {width, height} = texture.data;
    return {counties: ids.length, size: [width, height], spent};
}"""


def main() -> None:
    """Print what each step takes."""
    if not PAGE.is_file():
        sys.exit(f"{PAGE} is missing; build it with: make counties")
    with chromium() as browser:
        page = browser.new_page(reduced_motion="reduce")
        page.goto(PAGE.as_uri())
        page.wait_for_function("window.counties")
        found = page.evaluate(MEASURE)
    print(f"{found['counties']} counties, a texture of {found['size'][0]} x {found['size'][1]} texels")
    for name, times in found["spent"].items():
        middle = sorted(times)[len(times) // 4 : -len(times) // 4]
        print(f"{name:<14} {sum(middle) / len(middle):6.2f} ms")


if __name__ == "__main__":
    main()
