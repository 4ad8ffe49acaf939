"""A sheet as one HTML file that needs no other, for the screen and for a page of A4 or Letter."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from bellows_design.print_sheet.blocks import Block, Heading, Paragraph, Steps, Table

STYLE = """
@page { margin: 11mm 13mm; }
body { font: 9.2pt/1.28 "Liberation Sans", Arial, sans-serif; color: #111; margin: 0 auto;
  max-width: 190mm; }
h1 { font-size: 15pt; margin: 0 0 1.2mm; }
h2 { font-size: 10.6pt; margin: 2.6mm 0 0.7mm; border-bottom: 0.3mm solid #999; }
p { margin: 0.7mm 0; }
table { border-collapse: collapse; width: 100%; margin: 0.7mm 0; }
th, td { border: 0.2mm solid #bbb; padding: 0.3mm 1.4mm; text-align: left; vertical-align: top; }
th { background: #eee; }
ol { margin: 0.7mm 0; padding-left: 5mm; }
"""
"""Widths and margins leave the text on one page of either size, 210 mm × 297 mm and 8.5 in × 11."""


def as_html(title: str, blocks: Iterable[Block]) -> str:
    """A whole page."""
    body = "\n".join(_block(block) for block in blocks)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f"<title>{escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n"
        f"<body>\n{body}\n</body>\n</html>\n"
    )


def _block(block: Block) -> str:
    match block:
        case Heading(text, level):
            return f"<h{level}>{escape(text)}</h{level}>"
        case Paragraph(text):
            return f"<p>{escape(text)}</p>"
        case Table(headings, rows):
            head = _row("th", headings)
            return "\n".join(["<table>", head, *(_row("td", row) for row in rows), "</table>"])
        case Steps(steps):
            items = (f"<li><b>{escape(what)}</b> {escape(why)}</li>" for what, why in steps)
            return "\n".join(["<ol>", *items, "</ol>"])


def _row(tag: str, cells: Iterable[str]) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(cell)}</{tag}>' for cell in cells)}</tr>"
