// SPDX-License-Identifier: MIT
#pragma once

namespace dch::cli {

/// Style sheet of the pages: light or dark as the reader's system is.
inline constexpr const char* kPageStyle = R"css(
:root {
  color-scheme: light dark;
  --page: #f5f5f2; --card: #ffffff; --ink: #1d1d1b; --soft: #5d5c57; --rule: #e3e2dc;
  --blue: #2a78d6; --green: #1baf7a; --amber: #eda100; --red: #d03b3b; --good: #0b7a52;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #131312; --card: #1d1d1b; --ink: #f2f1ec; --soft: #b3b1a8; --rule: #383733;
    --blue: #3987e5; --green: #199e70; --amber: #c98500; --red: #e66767; --good: #4fd0a0;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink); font: 15px/1.5 system-ui, sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 28px 20px; }
header { display: flex; flex-wrap: wrap; align-items: center; justify-content: space-between; gap: 8px 20px; }
h1 { font-size: 24px; line-height: 1.25; margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 16px; margin: 0; }
.verdict { margin: 0; padding: 4px 12px; border-radius: 6px; border: 1px solid; font-weight: 600; }
.verdict.good { color: var(--good); }
.verdict.bad { color: var(--red); }
.verdict.plain { color: var(--soft); font-weight: 400; }
.card { background: var(--card); border: 1px solid var(--rule); border-radius: 8px; padding: 16px 18px; }
.card p { margin: 2px 0 10px; color: var(--soft); font-size: 13.5px; }
.wide { margin-top: 18px; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 460px), 1fr)); gap: 18px; margin-top: 18px; }
.charts > :last-child:nth-child(odd) { grid-column: 1 / -1; }
.charts > :last-child:nth-child(odd) svg { max-width: 720px; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: 2px 0; border-bottom: 1px solid var(--rule); overflow-wrap: anywhere; }
tr:last-child th, tr:last-child td { border-bottom: 0; }
th { width: 150px; padding-right: 16px; color: var(--soft); font-weight: 400; }
ul { margin: 0; padding-left: 20px; }
footer { margin-top: 18px; color: var(--soft); font-size: 13px; }
svg { display: block; width: 100%; height: auto; font: 12px system-ui, sans-serif; }
svg text { fill: var(--soft); }
svg .legend { fill: var(--ink); }
svg .y-tick, svg .y-label { text-anchor: end; }
svg .x-tick, svg .x-label { text-anchor: middle; }
svg .y-label, svg .x-label { fill: var(--ink); }
svg .grid { stroke: var(--rule); }
svg .zero, svg .tick { stroke: var(--soft); }
svg .blue { fill: var(--blue); }
svg .green { fill: var(--green); }
svg .amber { fill: var(--amber); }
svg polyline { fill: none; stroke-width: 1.8; stroke-linejoin: round; }
svg .line-blue { stroke: var(--blue); }
svg .line-green { stroke: var(--green); }
svg .line-amber { stroke: var(--amber); }
svg .heat { fill: var(--blue); shape-rendering: crispEdges; }
svg .frame { fill: none; stroke: var(--soft); }
svg .mark { fill: var(--red); }
svg .mean { stroke: var(--red); stroke-dasharray: 4 3; }
svg .mean-label { fill: var(--ink); }
svg .mean-label.left { text-anchor: end; }
)css";

}  // namespace dch::cli
