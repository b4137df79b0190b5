"""How a study's page looks, in light and dark; its switches need no script."""

from __future__ import annotations

COLOURS = (("#52525b", "#d4d4d8"), ("#0b62b8", "#6bb3ff"), ("#a87900", "#f5cf5b"), ("#d4431c", "#ff8f5e"),
           ("#8f1352", "#ff7fb5"), ("#047857", "#4fd1a5"), ("#7058c9", "#b8a5ff"))
"""Of the families in the order of their table: in light, and in dark; lightness differs besides hue, and so do the markers."""

_STYLE = """
:root { color-scheme: light dark; --page: #f7f7f5; --card: #ffffff; --ink: #1c1d21; --soft: #5b606b; --faint: #8d929c;
  --rule: #e2e3e6; --grid: #e9eaec; --minor: #f3f3f4; --good: #04724f; --bad: #b3261e; --fair: #8a5a00; --accent: #0b62b8;
  --zone: #8d929c22; LIGHT }
@media (prefers-color-scheme: dark) { :root { --page: #131417; --card: #1b1d21; --ink: #eceef2; --soft: #a9afbb; --faint: #7d838f;
  --rule: #2e3138; --grid: #292c32; --minor: #212328; --good: #52d39f; --bad: #ff8a80; --fair: #f2bb5c; --accent: #7cb8ff;
  --zone: #a9afbb1f; DARK } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink); font: 15px/1.55 system-ui, -apple-system, "Segoe UI", sans-serif; }
main { max-width: 1320px; margin: 0 auto; padding: 40px 24px 64px; }
h1 { font-size: 32px; line-height: 1.2; margin: 0; letter-spacing: -0.01em; } h2 { font-size: 19px; margin: 48px 0 4px; }
p { margin: 4px 0 12px; max-width: 82ch; } .soft { color: var(--soft); } small, .small { font-size: 13px; color: var(--soft); }
.eyebrow { color: var(--soft); font-size: 13px; letter-spacing: 0.06em; text-transform: uppercase; margin: 0 0 4px; }
.card { background: var(--card); border: 1px solid var(--rule); border-radius: 12px; padding: 22px 24px; }
.verdict { display: grid; gap: 20px; grid-template-columns: minmax(0, 3fr) minmax(0, 2fr); margin-top: 26px; }
.verdict h2 { margin: 0; font-size: 26px; letter-spacing: -0.01em; } .verdict .eyebrow { color: var(--good); }
.verdict .none .eyebrow { color: var(--bad); }
pre { background: var(--page); border: 1px solid var(--rule); border-radius: 8px; padding: 10px 14px; margin: 12px 0;
  overflow-x: auto; font: 14px/1.5 ui-monospace, "SF Mono", "DejaVu Sans Mono", monospace; }
dl { display: grid; grid-template-columns: auto 1fr; gap: 7px 18px; margin: 0; } dt { color: var(--soft); } dd { margin: 0; }
.good { color: var(--good); } .bad { color: var(--bad); } .fair { color: var(--fair); }
.switches { display: flex; flex-wrap: wrap; gap: 6px 22px; margin: 14px 0 12px; align-items: center; }
fieldset { border: 0; margin: 0; padding: 0; display: flex; flex-wrap: wrap; gap: 4px 12px; align-items: center; }
legend { float: left; color: var(--soft); margin-right: 10px; padding: 0; }
label { display: inline-flex; gap: 6px; align-items: center; cursor: pointer; } label svg { width: 26px; height: 14px; }
input { accent-color: var(--accent); margin: 0; } input:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(460px, 100%), 1fr)); gap: 20px; }
figure { margin: 0; } figcaption { font-weight: 600; margin: 0 0 6px; }
.plot { width: 100%; height: auto; display: block; } .plot text { fill: var(--soft); font-size: 12px; }
.plot .name { fill: var(--ink); } .plot .grid { stroke: var(--grid); } .plot .grid.minor { stroke: var(--minor); }
.plot .axis { stroke: var(--faint); fill: none; }
.plot path.tolerance { stroke: var(--ink); stroke-dasharray: 6 4; } .plot text.tolerance { fill: var(--ink); }
.plot rect.floor { fill: var(--zone); } .plot text.floor { fill: var(--faint); }
.plot text.failed { fill: var(--bad); } .plot path.failed { stroke: var(--bad); opacity: 0.35; }
.line { color: var(--faint); } .way, .spread { stroke: currentColor; fill: none; stroke-width: 2; stroke-linejoin: round; }
.spread { stroke-width: 1.2; } .dashed .way { stroke-dasharray: 5 4; stroke-width: 1.5; }
.mark { fill: currentColor; stroke: currentColor; stroke-width: 1.4; } .mark.hollow { fill: var(--card); }
.ring { fill: none; stroke: var(--ink); stroke-width: 1.6; }
.line.own { color: var(--ink); } .line.best { color: var(--good); } .line.sims { color: var(--f6); }
.wide { overflow-x: auto; } table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; font-size: 14px; }
th, td { padding: 5px 8px; text-align: right; white-space: nowrap; } th:first-child, td:first-child { text-align: left; }
thead th { position: sticky; top: 0; background: var(--card); color: var(--soft); font-weight: 500;
  border-bottom: 1px solid var(--rule); }
tbody tr:hover { background: var(--minor); } tbody.family tr:first-child td { border-top: 1px solid var(--rule); }
tr.best td { font-weight: 600; }
td .key { display: inline-block; width: 10px; height: 10px; border-radius: 3px; margin-right: 8px; background: currentColor; }
.said { text-align: left; white-space: normal; }
ul { padding-left: 20px; margin: 6px 0; max-width: 100ch; } li { margin: 3px 0; } code { font-size: 0.92em; }
footer { margin-top: 56px; color: var(--soft); font-size: 13px; border-top: 1px solid var(--rule); padding-top: 14px; }
@media (max-width: 760px) { .verdict { grid-template-columns: 1fr; } main { padding: 24px 14px 40px; } }
@media print { .switches { display: none; } .card { break-inside: avoid; } }
"""


def style(statistics: tuple[str, ...], families: int) -> str:
    """Return the style sheet; of the plots of several statistics the one that is chosen is shown."""
    light, dark = (" ".join(f"--f{k}: {colour[mode]};" for k, colour in enumerate(COLOURS)) for mode in (0, 1))
    rules = [_STYLE.replace("LIGHT", light).replace("DARK", dark)]
    for name in statistics:
        rules.append(f".of-{name} {{ display: none; }} main:has(#show-{name}:checked) .of-{name} {{ display: block; }}")
    for k in range(families):
        rules.append(f".line.f{k}, .f{k} .key, .key.f{k} {{ color: var(--f{k}); }}")
        rules.append(f"main:has(#hide-f{k}:not(:checked)) .plots .f{k} {{ display: none; }}")
    rules += [f"main:has(#hide-b{bits}:not(:checked)) .plots .b{bits} {{ display: none; }}" for bits in (32, 64)]
    return "\n".join(rules)
