"""Custom properties: references that multiply, chains and rings of them."""

from pathlib import Path

from styled_squares import SQUARE, colors, read_quietly


def test_references_that_multiply_have_no_value(tmp_path: Path) -> None:
    bomb = "".join(f"--a{n}: var(--a{n - 1}) var(--a{n - 1});" for n in range(1, 60))
    style = f"<style>path {{ --a0: red; {bomb} fill: var(--a59, blue) }}</style>"
    assert colors(read_quietly(tmp_path, style + SQUARE)) == [(0, 0, 1)]


def test_long_chains_and_rings_of_references(tmp_path: Path) -> None:
    links = "".join(f"--a{n}: var(--a{n + 1});" for n in range(3_000))
    chain = f"<style>svg {{ {links} --a3000: blue }} path {{ fill: var(--a0, red) }}</style>"
    assert colors(read_quietly(tmp_path, chain + SQUARE)) == [(0, 0, 1)]
    ring = chain.replace("--a3000: blue", "--a3000: var(--a7)")
    assert colors(read_quietly(tmp_path, ring + SQUARE)) == [(1, 0, 0)]


def test_rings_that_share_a_property_have_no_value(tmp_path: Path) -> None:
    style = (
        "--a: var(--b, red); --b: var(--a, red) var(--c, red); --c: var(--b, red); --d: var(--c, blue); fill: var(--{})"
    )
    for name, color in (("a", (0, 0, 0)), ("b", (0, 0, 0)), ("c", (0, 0, 0)), ("d", (0, 0, 1))):
        square = SQUARE.replace("/>", f' style="{style.format(name)}"/>')
        assert colors(read_quietly(tmp_path, square)) == [color]
