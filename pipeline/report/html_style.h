// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace trismooth {

/// The style sheet of the HTML report.
inline constexpr std::string_view html_style = R"css(
:root { --ink: #1c2430; --soft: #5b6675; --line: #e3e7ec; --before: #aeb8c4; --after: #2463eb;
        --good: #14804a; --bad: #b3261e; --mixed: #9a6700; --paper: #fff; color-scheme: light dark; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #e4e8ee; --soft: #9aa5b4; --line: #303844; --before: #5c6776; --after: #6ea0ff;
          --good: #58c48c; --bad: #ff8a80; --mixed: #e2b04a; --paper: #14181e; }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 15px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue",
       "Liberation Sans", Arial, sans-serif; -webkit-print-color-adjust: exact; print-color-adjust: exact; }
main { max-width: 1080px; margin: 0 auto; padding: 40px 32px 48px; }
header { border-bottom: 2px solid var(--ink); padding-bottom: 16px; }
.kind { color: var(--soft); font-size: 13px; letter-spacing: .08em; text-transform: uppercase; }
h1 { margin: 2px 0 4px; font-size: 30px; line-height: 1.2; overflow-wrap: anywhere; }
h2 { margin: 40px 0 12px; font-size: 18px; }
h3 { margin: 0 0 8px; font-size: 14px; color: var(--soft); font-weight: 600; }
p { margin: 0 0 8px; }
.soft, small { color: var(--soft); }
small { display: block; white-space: normal; font-size: 12px; line-height: 1.35; font-weight: 400; }
.lead { margin: 20px 0 0; font-size: 17px; }
.lead.bad { color: var(--bad); }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(272px, 1fr)); gap: 14px; margin-top: 22px; }
.card { border: 1px solid var(--line); border-radius: 8px; padding: 14px 16px 12px; break-inside: avoid; }
.card .label { color: var(--soft); font-size: 13px; }
.card .value { font-size: 22px; line-height: 1.45; white-space: nowrap; font-weight: 650; font-variant-numeric: tabular-nums; }
.card .from { color: var(--soft); font-weight: 400; }
.good { color: var(--good); }
.bad { color: var(--bad); }
.mixed { color: var(--mixed); }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { padding: 6px 10px; border-bottom: 1px solid var(--line); text-align: right; vertical-align: top;
         white-space: nowrap; }
th { color: var(--soft); font-size: 13px; font-weight: 600; }
th:first-child, td:first-child, td.word { text-align: left; }
td:first-child { padding-left: 0; }
th:first-child { padding-left: 0; }
table.wrap th { white-space: normal; }
thead tr:not(:last-child) th { border-bottom: 0; }
thead tr:last-child th { border-bottom: 1px solid var(--soft); }
th.group { text-align: center; border-bottom: 0; padding-bottom: 0; }
td.start, th.start { border-left: 1px solid var(--line); }
td.strong { font-weight: 650; }
td.text { white-space: normal; overflow-wrap: anywhere; }
tr { break-inside: avoid; }
.two { display: grid; grid-template-columns: 1fr 1fr; gap: 0 40px; }
figure { margin: 0; break-inside: avoid; }
.legend { display: flex; gap: 18px; margin: 0 0 4px; color: var(--soft); font-size: 13px; }
.legend i { display: inline-block; width: 12px; height: 12px; margin-right: 6px; border-radius: 2px;
            vertical-align: -1px; }
i.before { background: var(--before); }
i.after { background: var(--after); }
svg.chart { display: block; width: calc(100% - 64px); margin-left: 48px; overflow: visible; }
svg.chart text { fill: var(--soft); font-size: 12px; }
svg.chart .grid { stroke: var(--line); stroke-width: 1; }
svg.chart rect.before { fill: var(--before); }
svg.chart rect.after { fill: var(--after); }
svg.chart .curve { fill: none; stroke: var(--after); stroke-width: 2; stroke-linejoin: round; }
svg.chart .dot { fill: var(--paper); stroke: var(--after); stroke-width: 2; }
.meter { width: 40%; }
.meter span { display: block; height: 9px; margin-top: 7px; border-radius: 2px; background: var(--after);
              min-width: 1px; }
ul { margin: 0; padding-left: 20px; }
code { font: 13px ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; overflow-wrap: anywhere; }
footer { margin-top: 44px; border-top: 1px solid var(--line); padding-top: 12px; color: var(--soft); font-size: 13px; }
@media (max-width: 600px) {
  main { padding: 20px 16px 32px; }
  h1 { font-size: 24px; }
  .card .value, th, td { white-space: normal; overflow-wrap: anywhere; }
  th, td { padding: 6px 4px; }
}
@media screen and (max-width: 960px) {
  .two { grid-template-columns: minmax(0, 1fr); }
  /* A row of many columns becomes a block: its name over lines of one value, or of two. */
  table.stack { display: block; }
  table.stack thead { display: none; }
  table.stack tbody { display: grid; grid-template-columns: repeat(auto-fill, minmax(280px, 1fr)); gap: 0 40px; }
  table.stack tr { display: grid; grid-template-columns: minmax(0, 1fr) 8em; align-content: start; gap: 2px 0;
                   padding: 8px 0; border-bottom: 1px solid var(--line); }
  table.stack td { border: 0; padding: 0; white-space: nowrap; }
  table.stack td:first-child { grid-area: 1 / 1; font-weight: 650; white-space: normal; }
  table.stack td.word { grid-area: 1 / 2; text-align: right; }
  table.stack td[data-label] { display: flex; justify-content: space-between; grid-column: 1 / -1; }
  table.stack td.start { grid-column: 1; }
  table.stack td[data-label]::before { content: attr(data-label); color: var(--soft); }
  table.stack td.start + td::before { content: "→ "; color: var(--soft); }
}
@media print { main { max-width: none; padding: 0; } body { font-size: 11pt; } h2 { break-after: avoid; }
               .cards { grid-template-columns: repeat(3, 1fr); } @page { margin: 16mm; } }
)css";

}  // namespace trismooth
