"""The page of a report: one HTML file beside its pictures and its JSON."""

import html
import json
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from importlib.resources import files
from io import BytesIO
from typing import Any

from vexture_evidence.figures.style import RESOLUTION
from vexture_evidence.report.section import Printed, PrintedPicture, Section, Table

POLICY = "default-src 'none'; img-src 'self' data:; style-src 'unsafe-inline'"
"""The page loads only its own pictures and runs no scripts."""

MARKED = (
    "<p>Every number was measured in the run that made this page, except those that "
    '<span class="printed">the thesis printed</span>, which are marked like these words.</p>'
)
"""Explains the colours of numbers."""

TEXT_CLASS = ' class="text"'
"""Attribute that aligns columns of text at the left."""

PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<title>{title}</title>
<style>
{style}
</style>
</head>
<body>
<nav aria-label="Contents">
<ol>
{contents}
</ol>
</nav>
<main>
<h1>{title}</h1>
{lead}
{sections}
</main>
</body>
</html>
"""


def page(title: str, machine: Mapping[str, Any], lead: Sequence[str], sections: Sequence[Section]) -> str:
    """Text of the page.

    Parameters
    ----------
    title : str
    machine : mapping
        Facts about the machine that the report was measured on: name and value of each.
    lead : sequence of str
        Paragraphs before all sections.
    sections : sequence of Section
        Their pictures are expected in ``figures/NAME.png`` beside the page.

    Examples
    --------
    >>> "<h2>Bytes</h2>" in page("Report", {}, [], [Section("bytes", "Bytes")]).replace(' id="bytes"', "")
    True
    """
    facts = "".join(
        f"<dt>{html.escape(name)}</dt><dd>{html.escape(str(value))}</dd>" for name, value in machine.items()
    )
    return PAGE.format(
        policy=POLICY,
        title=html.escape(title),
        style=files("vexture_evidence.report").joinpath("page.css").read_text(encoding="utf-8"),
        contents="\n".join(_contents(section) for section in sections),
        lead="\n".join([*map(_paragraph, lead), MARKED, f"<dl>{facts}</dl>"]),
        sections="\n".join(_section(section, 2) for section in sections),
    )


def pictures_of(sections: Sequence[Section]) -> Iterator[PrintedPicture]:
    """All pictures, in order."""
    for section in sections:
        for item in section.items:
            if isinstance(item, Section):
                yield from pictures_of([item])
            elif isinstance(item, PrintedPicture):
                yield item


def png_of(picture: PrintedPicture) -> bytes:
    """Contents of a picture's file."""
    data = BytesIO()
    picture.figure.savefig(data, format="png", dpi=RESOLUTION)
    return data.getvalue()


def known(facts: Any) -> Any:
    """Convert facts for a JSON file: numbers that are not finite become null, and `Printed` values are marked.

    Examples
    --------
    >>> known({"ms": Printed(53.1), "mae": float("nan")})
    {'ms': {'printed': 53.1}, 'mae': None}
    """
    if isinstance(facts, Printed):
        return {"printed": facts.value}
    if isinstance(facts, Section):
        items = {item.name if isinstance(item, Table) else item.anchor: known(item) for item in facts.items
                 if not isinstance(item, PrintedPicture)}  # fmt: skip
        return {"title": facts.title, **known(facts.facts), **items}
    if isinstance(facts, Table):
        return {"head": list(facts.head), "rows": known(facts.rows)}
    if isinstance(facts, Mapping):
        return {str(key): known(value) for key, value in facts.items()}
    if isinstance(facts, list | tuple):
        return [known(value) for value in facts]
    facts = _plain(facts)
    return None if isinstance(facts, float) and not math.isfinite(facts) else facts


def _plain(value: Any) -> Any:
    """Convert a NumPy scalar to a Python number; return anything else unchanged."""
    return value.item() if hasattr(value, "item") else value


def _contents(section: Section) -> str:
    inner = "".join(_contents(item) for item in section.items if isinstance(item, Section))
    link = f'<a href="#{section.anchor}">{html.escape(section.title)}</a>'
    return f"<li>{link}{f'<ol>{inner}</ol>' if inner else ''}</li>"


def _section(section: Section, level: int) -> str:
    parts = [f'<h{level} id="{section.anchor}">{html.escape(section.title)}</h{level}>', *map(_paragraph, section.text)]
    for item in section.items:
        if isinstance(item, Section):
            parts.append(_section(item, level + 1))
        else:
            parts.append(_table(item) if isinstance(item, Table) else _picture(item))
    return "\n".join(parts)


def _paragraph(text: str) -> str:
    return f"<p>{_inline(text)}</p>"


def _inline(text: str) -> str:
    marked = re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(text))
    return re.sub("⟦([^⟦⟧]*)⟧", r'<span class="printed">\1</span>', marked)


def _picture(picture: PrintedPicture) -> str:
    width, height = (round(side * RESOLUTION) for side in picture.figure.get_size_inches())
    # shown at 96 pixels per inch, so that a screen of twice that density shows nearly all pixels of the file
    shown = round(width * 96 / RESOLUTION), round(height * 96 / RESOLUTION)
    return (
        f'<figure id="figure-{picture.name}"><a href="figures/{picture.name}.png">'
        f'<img src="figures/{picture.name}.png" width="{shown[0]}" height="{shown[1]}" loading="lazy" '
        f'alt="{html.escape(picture.alt)}"></a><figcaption>{_inline(picture.caption)}</figcaption></figure>'
    )


def _table(table: Table) -> str:
    groups = [head.rpartition(": ")[0] for head in table.head]
    texts = [any(isinstance(row[place], str) for row in table.rows) for place in range(len(table.head))]
    lower = "".join(
        f"<th{TEXT_CLASS if text else ''}>{_inline(head.rpartition(': ')[2])}</th>"
        for head, text in zip(table.head, texts, strict=True)
    )
    rows = "".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in table.rows)
    head = f"<thead>{_groups(groups)}<tr>{lower}</tr></thead>"
    caption = f"<caption>{_inline(table.caption)}</caption>"
    return f'<div class="wide"><table id="table-{table.name}">{caption}{head}<tbody>{rows}</tbody></table></div>'


def _groups(groups: Sequence[str]) -> str:
    """Row of the headings that span several columns, if there are any."""
    if not any(groups):
        return ""
    spans: list[list[Any]] = []
    for group in groups:
        if spans and spans[-1][0] == group:
            spans[-1][1] += 1
        else:
            spans.append([group, 1])
    cells = (f'<th class="group" colspan="{n}">{_inline(group)}</th>' if group else f'<th colspan="{n}"></th>'
             for group, n in spans)  # fmt: skip
    return f"<tr>{''.join(cells)}</tr>"


def _cell(value: Any) -> str:
    if isinstance(value, Printed):
        return f'<td class="printed">{_format_value(value.value)}</td>'
    kind = TEXT_CLASS if isinstance(value, str) else ""
    return f"<td{kind}>{_format_value(value)}</td>"


def _format_value(value: Any) -> str:
    """Format a value for readers: three significant digits, thousands separated, a dash if there is no value."""
    value = _plain(value)
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    if isinstance(value, str):
        return _inline(value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return f"{value:,}"
    if value == 0.0:
        return "0"
    magnitude = math.floor(math.log10(abs(value)))
    if magnitude < -3:
        digits, exponent = f"{value:.1e}".split("e")
        return f"{digits}·10<sup>{int(exponent)}</sup>"
    return f"{value:,.{max(0, 2 - magnitude)}f}"


def json_text(machine: Mapping[str, Any], sections: Sequence[Section]) -> str:
    """Everything that was measured, as JSON."""
    facts = {"machine": known(machine), **{section.anchor: known(section) for section in sections}}
    return json.dumps(facts, indent=1, allow_nan=False, ensure_ascii=False) + "\n"
