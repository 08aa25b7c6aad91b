# SPDX-License-Identifier: MIT
"""The report: one page without scripts and without other files."""

import html
import os
import re

from . import plot, ratios, words

STYLE = """
body { font: 15px/1.5 sans-serif; color: #222; background: #fff; max-width: 76em; margin: 2em auto; padding: 0 1em; }
div.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: 1em 0; font-size: 13px; }
thead th { border-bottom: 2px solid #999; }
th, td { padding: 2px 10px; border-bottom: 1px solid #ddd; text-align: left; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
tr:hover td { background: #f4f6fa; }
p.warning { background: #fff3d6; padding: .6em 1em; }
pre { background: #f6f6f6; padding: .6em 1em; overflow-x: auto; font-size: 12px; }
.plots { display: flex; flex-wrap: wrap; gap: 1em; }
figure { margin: 0; } figcaption { font-weight: bold; }
figure { max-width: 100%; overflow-x: auto; }
td.better, td.held { color: #05602c; } td.worse, td.missed { color: #a3140d; }
td.words:nth-child(2) { white-space: nowrap; } td.held, td.missed { font-weight: bold; } td.unmeasured { color: #8a5a00; }
details > summary { cursor: pointer; color: #1b5fc1; }
"""


def cell(text, kind=""):
    looks_like_number = re.fullmatch(r"-?[0-9][0-9.,]*(e[-+]?[0-9]+)?( \.\. -?[0-9][-+0-9.,e]*)?", text) is not None
    classes = " ".join(filter(None, ["number" if looks_like_number else "", kind]))
    return f"<td class='{classes}'>{html.escape(text)}</td>" if classes else f"<td>{html.escape(text)}</td>"


def table(columns, rows):
    """Rows are of cells in HTML."""
    head = "".join(f"<th>{html.escape(c)}</th>" for c in columns)
    body = "\n".join("<tr>" + "".join(row) + "</tr>" for row in rows)
    return f"<div class='wide'><table><thead><tr>{head}</tr></thead><tbody>\n{body}\n</tbody></table></div>"


def measured(measurements):
    rows = []
    for m in measurements:
        texts = words.measured_row(m)
        cells = [cell(text) for text in texts]
        if "ratio" in m:
            cells[6] = cell(texts[6], "better" if m["ratio"]["high"] < 1 else "worse" if m["ratio"]["low"] > 1 else "")
        rows.append(cells)
    return table(words.MEASURED, rows)


def prose(text):
    """Words with `code` in them."""
    return re.sub(r"`([^`]*)`", r"<code>\1</code>", html.escape(text))


def aims_and_records(records):
    kinds = {ratios.HELD: "held", ratios.MISSED: "missed", ratios.NO_RECORD: "unmeasured"}
    parts = ["<h2 id='aims'>Aims and records</h2>", f"<p>{html.escape(ratios.NOTE)}</p>",
             f"<p>{html.escape(ratios.summary(records))}</p>"]
    for group in ratios.groups():
        rows = [[f"<td class='{kinds.get(text, 'words')}'>{html.escape(text)}</td>" for text in row]
                for row in ratios.rows_of(group, records)]
        parts.append(f"<h3>{html.escape(group['title'])}</h3><p>Discussed in {html.escape(group['source'])}.</p>")
        parts.append(table(ratios.COLUMNS, rows))
    reasons = "".join(f"<li>{prose(reason)}</li>" for reason in ratios.reasons(records))
    return "\n".join([*parts, f"<h2 id='when-not'>{ratios.WHEN_NOT_TITLE}</h2><ul>{reasons}</ul>"])


def family(record):
    parts = [f"<h2 id='{record['family']}'>{html.escape(record['title'])}</h2>"]
    if record["checked"]:
        parts.append(f"<p>{html.escape(record['checked'])}</p>")
    facts = [[cell(name), cell(value)] for name, value in words.facts(record) if value and value != "-" and name != "checked"]
    parts.append(f"<details><summary>Run on {html.escape(record['machine']['cpu'])}; {len(record['commands'])} commands"
                 f"</summary>{table(['', ''], facts)}<pre>{html.escape(chr(10).join(record['commands']))}</pre></details>")
    parts += [f"<p class='warning'>Left out: {html.escape(reason)}</p>" for reason in record["left_out"]]
    if record["plots"]:
        parts.append("<div class='plots'>" + "".join(
            f"<figure><figcaption>{html.escape(p['title'])}</figcaption>{plot.svg(p)}</figure>" for p in record["plots"])
            + "</div>")
    if record["measurements"]:
        parts.append(measured(record["measurements"]))
    for one in record["tables"]:
        parts.append(f"<h3>{html.escape(one['title'])}</h3>")
        if one["note"]:
            parts.append(f"<p>{html.escape(one['note'])}</p>")
        parts.append(table(one["columns"], [[cell(words.number(c)) for c in row] for row in one["rows"]]))
    return "\n".join(parts)


def page(records, missing=()):
    targets = [("aims", "Aims and records"), ("when-not", ratios.WHEN_NOT_TITLE)]
    targets += [(r["family"], r["title"]) for r in records]
    links = " · ".join(f"<a href='#{name}'>{html.escape(title)}</a>" for name, title in targets)
    warning = words.warning(records, missing)
    parts = ["<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'/>"
             "<meta name='viewport' content='width=device-width, initial-scale=1'/><title>dch: benchmarks</title>",
             f"<style>{STYLE}</style></head><body><h1>dch: benchmarks</h1><p>{links}</p>"]
    if warning:
        parts.append(f"<p class='warning'>{html.escape(warning)}</p>")
    parts.append("<p>A ratio below 1 is in favor of what stands in the row. It is the median over runs of the ratio of both "
                 "in the same run; it is colored where all runs agree.</p>")
    parts.append(aims_and_records(records))
    return "\n".join(parts + [family(r) for r in records] + ["</body></html>"])


def write(path, records, missing=()):
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(page(records, missing) + "\n")
    os.replace(path + ".part", path)
