# SPDX-License-Identifier: BSD-3-Clause
"""What Jupyter shows of results: the top of the program's HTML report, without scripts or styles for other elements."""

from __future__ import annotations

import math
from html import escape
from typing import TYPE_CHECKING, List, Optional, Sequence, Tuple

from ._core import QualityReport, stop_reasons, where_lines_are
from ._result import free_moved

if TYPE_CHECKING:
    from ._result import Result

_SCOPE = "trismooth-report"

# Every rule is for what is inside of this element. Colours of text and lines are those of the page, so that they suit
# dark pages; the few others have a variant for the dark themes of JupyterLab, VS Code, Colab and Sphinx, by their names
# for these. What the system prefers does not count: notebooks have themes of their own.
_STYLE = """
.S { --before: #aeb8c4; --after: #2463eb; --good: #14804a; --bad: #b3261e; --line: rgba(128, 140, 155, .3);
     max-width: 900px; margin: 4px 0 12px; font: 14px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue",
     "Liberation Sans", Arial, sans-serif; }
[data-jp-theme-light="false"] .S, .vscode-dark .S, .vscode-high-contrast .S, html[theme="dark"] .S,
[data-theme="dark"] .S { --before: #7a8695; --after: #5b8cff; --good: #4cc38a; --bad: #ff8a80; }
.S .soft { opacity: .72; }
.S .good { color: var(--good); }
.S .bad { color: var(--bad); }
.S .lead { font-size: 16px; margin: 4px 0 0; }
.S .note { font-size: 13px; margin: 4px 0 0; }
.S .cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(230px, 1fr)); gap: 12px; margin-top: 14px; }
.S .card { border: 1px solid var(--line); border-radius: 8px; padding: 10px 14px 9px; }
.S .label { display: flex; justify-content: space-between; font-size: 12.5px; }
.S .value { font-size: 20px; line-height: 1.45; font-weight: 650; font-variant-numeric: tabular-nums; }
.S .value span { white-space: nowrap; }
.S .from { opacity: .72; font-weight: 400; }
.S .detail { font-size: 12px; line-height: 1.35; }
.S .title { font-size: 15px; font-weight: 650; margin: 22px 0 6px; }
.S .legend { display: flex; gap: 18px; margin: 0 0 4px; font-size: 12.5px; }
.S .legend i { display: inline-block; width: 12px; height: 12px; margin-right: 6px; border-radius: 2px;
               vertical-align: -1px; }
.S i.before { background: var(--before); }
.S i.after { background: var(--after); }
.S svg { display: block; width: calc(100% - 72px); max-width: none; height: 230px; margin-left: 56px;
         overflow: visible; }
.S svg text { fill: currentColor; fill-opacity: .72; font-size: 12px; }
.S svg line { stroke: var(--line); stroke-width: 1; }
.S svg rect.before { fill: var(--before); }
.S svg rect.after { fill: var(--after); }
""".replace(".S", f".{_SCOPE}")

# Decimals of what the cards show, as in the program's reports.
_DECIMALS = {"shape": 5, "min_angle": 3, "max_angle": 3}


def result_html(result: Result) -> str:
    """Return what Jupyter shows of a result: the outcome, the key figures before and after, and the histogram.

    Parameters
    ----------
    result : Result

    Returns
    -------
    str
        A ``<div>``, well-formed, with a style sheet that is for this element alone. Where the quality was not asked
        for, the outcome and the time are there alone.
    """
    before, after = (result.before, result.after) if result.has_quality else (None, None)
    body = [_lead(_outcome(result, after), after)]
    # Of files there are sentences about what did not go as one may expect.
    remarks = [result.note, *getattr(result, "warnings", []), *getattr(result, "losses", [])]
    body += [f'<div class="note soft">{escape(remark)}</div>' for remark in remarks if remark]
    time = _time_card(result)
    if before is None or after is None:
        body += ['<div class="note soft">The quality was not computed: pass quality=True.</div>', _cards([time])]
    elif _elements(after) > 0:
        body += [_cards([*_quality_cards(before, after), time]), _histogram(before, after)]
    return _page(body)


def quality_html(report: QualityReport) -> str:
    """Return what Jupyter shows of a quality report: the key figures and the histogram.

    Parameters
    ----------
    report : QualityReport

    Returns
    -------
    str
        As :func:`result_html`.
    """
    # Where elements are inverted, the sentence about them says how many there are in all.
    says_count = _elements(report) > 0 and report.inverted == 0
    body = [_lead(f"{_counts(report)}." if says_count else "", report)]
    if _elements(report) > 0:
        body += [_cards(_quality_cards(None, report)), _histogram(None, report)]
    return _page(body)


def _page(parts: Sequence[str]) -> str:
    content = "\n".join(parts)
    return f'<div class="{_SCOPE}">\n<style>{_STYLE}</style>\n{content}\n</div>'


def _plural(count: int) -> str:
    return "" if count == 1 else "s"


def _outcome(result: Result, after: Optional[QualityReport]) -> str:
    """Return what happened, in a sentence; nothing of a mesh without triangles."""
    if after is not None and _elements(after) == 0:
        return ""
    if result.moved == 0:
        why = {"quality_target": "The mesh has the target quality already", "time_limit": "There was no time for a sweep"}
        nothing = why.get(result.stop_reason) if result.sweeps == 0 else None
        return f"{nothing or 'No vertex could be improved'}: the mesh is as it was."
    reason = stop_reasons().get(result.stop_reason, result.stop_reason)
    sliding = result.sliding
    slid = ""
    if sliding is not None and sliding.vertices > 0:
        slid = f", and {sliding.slid:,} of {sliding.vertices:,} on lines slid,"
    text = (
        f"{free_moved(result):,} of {result.free_vertices:,} free vertices moved{slid} in {result.sweeps:,} "
        f"sweep{_plural(result.sweeps)}; {reason}."
    )
    if sliding is not None:
        text += _sentence(where_lines_are(sliding))
    if result.reverted > 0:
        text += f" The guard put {result.reverted:,} back."
    if not result.reproducible:
        text += " Not reproducible."
    return text


def _sentence(text: str) -> str:
    return f" {text[0].upper()}{text[1:]}." if text else ""


def _lead(outcome: str, report: Optional[QualityReport]) -> str:
    """Return the first lines: what happened, and whether the triangles are valid, as far as that is known."""
    sentences = [outcome]
    if report is not None:
        name, count = _name_of_elements(report), _elements(report)
        if count == 0:
            sentences.append("The mesh has no triangles.")
        elif report.inverted > 0:
            verb = "is" if count == 1 else "are"
            sentences.append(f"{report.inverted:,} of {count:,} {name}s {verb} inverted.")
        else:
            sentences.append(f"No {name} is inverted.")
        if report.degenerate > 0:
            subject = f"1 {name} is" if report.degenerate == 1 else f"{report.degenerate:,} {name}s are"
            flat = "" if name == "triangle" else " or flat at a corner"
            sentences.append(f"{subject} without area{flat}.")
    is_bad = report is not None and report.inverted + report.degenerate > 0
    text = escape(" ".join(sentence for sentence in sentences if sentence))
    return f'<div class="lead{" bad" if is_bad else ""}">{text}</div>'


def _cards(cards: Sequence[str]) -> str:
    return '<div class="cards">\n' + "\n".join(cards) + "\n</div>"


def _card(label: str, value: str, detail: str, verdict: str = "") -> str:
    judged = f'<span class="{_verdict_class(verdict)}">{verdict}</span>' if verdict else ""
    return (
        f'<div class="card"><div class="label"><span class="soft">{label}</span>{judged}</div>'
        f'<div class="value">{value}</div><div class="detail soft">{escape(detail)}</div></div>'
    )


def _elements(report: QualityReport) -> int:
    return report.triangles + report.quadrilaterals


def _name_of_elements(report: QualityReport) -> str:
    if report.quadrilaterals == 0:
        return "triangle"
    return "quadrilateral" if report.triangles == 0 else "element"


def _counts(report: QualityReport) -> str:
    counts = {"triangle": report.triangles, "quadrilateral": report.quadrilaterals}
    shown = {name: count for name, count in counts.items() if count > 0}
    return " and ".join(f"{count:,} {name}{_plural(count)}" for name, count in shown.items())


def _verdict_class(verdict: str) -> str:
    return {"better": "good", "worse": "bad"}.get(verdict, "soft")


def _quality_cards(before: Optional[QualityReport], after: QualityReport) -> List[str]:
    acceptable = _percent(after["shape"].acceptable_fraction)
    best = {"triangle": ("equilateral", "60° is equilateral"), "quadrilateral": ("a square", "90° is a rectangle")}.get(
        _name_of_elements(after), ("equilateral or a square", "60° is equilateral, 90° a rectangle")
    )
    share = f"{acceptable} % of the {_name_of_elements(after)}s are acceptable"
    return [
        _metric_card("Smallest shape", "shape", "min", before, after, f"1 is {best[0]}, 0 degenerate"),
        _metric_card("Mean shape", "shape", "mean", before, after, share),
        _metric_card("Smallest angle", "min_angle", "min", before, after, best[1], "°"),
        _metric_card("Largest angle", "max_angle", "max", before, after, best[1], "°"),
        _inverted_card(before, after),
    ]


def _metric_card(
    label: str,
    metric: str,
    figure: str,
    before: Optional[QualityReport],
    after: QualityReport,
    detail: str,
    unit: str = "",
) -> str:
    new = getattr(after[metric], figure)
    if before is None:
        return _card(label, f"<span>{_number(new, _DECIMALS[metric])}{unit}</span>", detail)
    old = getattr(before[metric], figure)
    old_text, new_text = _distinct(old, new, _DECIMALS[metric])
    verdict = _verdict(old, new, larger_is_better=metric != "max_angle")
    return _card(label, _change(old_text + unit, new_text + unit), detail, verdict)


def _inverted_card(before: Optional[QualityReport], after: QualityReport) -> str:
    degenerate = f"{after.degenerate:,}"
    if before is not None and before.degenerate != after.degenerate:
        degenerate = f"{before.degenerate:,} → {degenerate}"
    label = f"Inverted {_name_of_elements(after)}s"
    detail = f"of {_elements(after):,}; {degenerate} degenerate"
    now = f'<span class="{"bad" if after.inverted > 0 else "good"}">{after.inverted:,}</span>'
    if before is None:
        return _card(label, now, detail)
    verdict = _verdict(before.inverted, after.inverted, larger_is_better=False)
    return _card(label, f'<span class="from">{before.inverted:,} →</span> {now}', detail, verdict)


def _time_card(result: Result) -> str:
    """Return the card of the time in trismooth, which is not that for reports and for the caller's arrays."""
    threads = f", {result.threads} thread{_plural(result.threads)}" if result.threads > 0 else ""
    where = f"on {result.device}{threads}" if result.device else f"by {result.backend}{threads}"
    return _card("Time", f"<span>{_duration(sum(result.timings.values()))}</span>", where)


def _change(before: str, after: str) -> str:
    return f'<span class="from">{before} →</span> <span>{after}</span>'


def _verdict(before: float, after: float, larger_is_better: bool) -> str:
    if math.isnan(before) or math.isnan(after):
        return ""
    # What no card shows is no change: "worse" beside equal numbers would only alarm.
    if math.isclose(before, after, rel_tol=1e-6):
        return "same"
    return "better" if (after > before) == larger_is_better else "worse"


def _number(value: float, decimals: int, more: int = 0) -> str:
    """Return the number with so many decimals, or fewer if it is large: as the program's reports show it."""
    if math.isnan(value):
        return "-"
    if value == 0 or math.isinf(value):
        return f"{value:g}" if value else "0"
    magnitude = abs(value)
    if magnitude < 10.0 ** (2 - decimals) or magnitude >= 1e4:
        return f"{value:.{2 + more}e}"
    places_before_point = len(str(int(magnitude)))
    return f"{value:.{min(decimals, 6 - places_before_point) + more}f}"


def _distinct(before: float, after: float, decimals: int) -> Tuple[str, str]:
    """Return both numbers, with more digits where they would look the same and the change is one that counts."""
    texts = _number(before, decimals), _number(after, decimals)
    if texts[0] == texts[1] and not math.isclose(before, after, rel_tol=1e-6):
        return _number(before, decimals, 3), _number(after, decimals, 3)
    return texts


def _percent(fraction: float) -> str:
    """Return the percentage. Only all are 100, and only none are 0."""
    if math.isnan(fraction):
        return "-"
    if fraction in (0, 1):
        return "100" if fraction else "0"
    return f"{min(max(math.floor(fraction * 1e4) / 100, 0.01), 99.99):.2f}"


def _duration(milliseconds: float) -> str:
    if milliseconds < 9.95:
        return f"{milliseconds:.2f} ms"
    return f"{milliseconds:.0f} ms" if milliseconds < 999.5 else f"{milliseconds / 1000:.1f} s"


# Heights of the chart, in pixels. Places along its width are in hundredths of it: so its letters are of one size in
# cells of any width. What stands left of 0 is in the margin that the style sheet leaves.
_HEIGHT, _TOP, _BOTTOM = 230.0, 30.0, 188.0
# Counts are on a logarithmic scale. 0 has a place half a decade below 1, so that one triangle is seen beside a million.
_ZERO_GAP = 0.5


def _histogram(before: Optional[QualityReport], after: QualityReport) -> str:
    """Return the histogram of shape, as an SVG with its title and legend."""
    reports = [("after", after)] if before is None else [("before", before), ("after", after)]
    any_inverted = any(report.inverted > 0 for _, report in reports)
    series = [(name, [report.inverted] * any_inverted + list(report.histogram)) for name, report in reports]
    labels = ["inverted"] * any_inverted + [f"{i / 20:.2f} to {(i + 1) / 20:.2f}" for i in range(20)]
    decades = max(1, math.ceil(math.log10(max(1, *(count for _, counts in series for count in counts)))))
    content = [*_grid(decades), *_shape_axis(any_inverted)]
    for i, (name, counts) in enumerate(series):
        content += _bars(name, counts, labels, decades, i, len(series))
    legend = "".join(f'<span><i class="{name}"></i>{name}</span>' for name, _ in series)
    return (
        '<div class="title">Distribution of shape</div>\n'
        + (f'<div class="legend">{legend}</div>\n' if len(series) > 1 else "")
        + f'<svg width="100%" height="{_HEIGHT:g}" role="img" aria-label="Histogram of shape">\n'
        + f'<text x="-56" y="12">{_name_of_elements(after)}s, on a logarithmic scale</text>\n'
        + "\n".join(content)
        + "\n</svg>"
    )


def _height_of(count: int, decades: int) -> float:
    """Return the place of a count on the scale, from the top of the chart."""
    if count == 0:
        return _BOTTOM
    return _BOTTOM - (_ZERO_GAP + math.log10(count)) * (_BOTTOM - _TOP) / (decades + _ZERO_GAP)


def _grid(decades: int) -> List[str]:
    lines = []
    for count in [0, *(10**decade for decade in range(decades + 1))]:
        y = _height_of(count, decades)
        lines.append(f'<line x1="0" y1="{y:.1f}" x2="100%" y2="{y:.1f}"></line>')
        lines.append(f'<text x="-8" y="{y + 4:.1f}" text-anchor="end">{_short_count(count)}</text>')
    return lines


def _short_count(count: int) -> str:
    for unit, letter in ((1_000_000, "M"), (1_000, "K")):
        if count >= unit:
            return f"{count // unit}{letter}"
    return str(count)


def _shape_axis(any_inverted: bool) -> List[str]:
    zero = 1 / 21 if any_inverted else 0.0
    places = [(zero + i / 10 * (1 - zero), f"{i / 10:.1f}") for i in range(any_inverted, 11)]
    if any_inverted:
        places.insert(0, (zero / 2, "&lt; 0"))
    labels = [
        f'<text x="{100 * place:.3f}%" y="{_BOTTOM + 17:.1f}" text-anchor="middle">{label}</text>'
        for place, label in places
    ]
    title = f'<text x="50%" y="{_HEIGHT - 6:.1f}" text-anchor="middle">shape (1 is the best)</text>'
    return [*labels, title]


def _bars(name: str, counts: Sequence[int], labels: Sequence[str], decades: int, index: int, of: int) -> List[str]:
    """Return the bars of one series, beside those of the others, with their counts as tooltips."""
    place = 100 / len(counts)
    gap = 0.14 * place
    width = (place - gap) / of
    when = f", {name}" if of > 1 else ""
    bars = []
    for i, (count, label) in enumerate(zip(counts, labels)):
        if count > 0:
            x, y = i * place + gap / 2 + index * width, _height_of(count, decades)
            bars.append(
                f'<rect class="{name}" x="{x:.3f}%" y="{y:.1f}" width="{width:.3f}%" height="{_BOTTOM - y:.1f}">'
                f"<title>{label}{when}: {count:,}</title></rect>"
            )
    return bars
