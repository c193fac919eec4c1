// The look of the report: light, dark and print.
#pragma once

namespace rink::loadgen {

/// CSS. Line colours are Okabe and Ito's colour-blind-safe set (2008), darkened for white paper and lightened for the dark page; s0 to s5 are series, p0 to
/// p2 the parts of a bar.
inline constexpr const char* report_style = R"css(
:root{color-scheme:light dark;--ink:#1b1f24;--faint:#59636e;--paper:#fff;--card:#f6f8fa;--grid:#dfe3e8;--warn:#b3261e;--s0:#0072b2;--s1:#d55e00;
--s2:#008a63;--s3:#b3498a;--s4:#996600;--s5:#3d7ea6;--p0:#8a94a0;--p1:#e69f00;--p2:#56b4e9}
@media screen and (prefers-color-scheme:dark){:root{--ink:#e6e9ec;--faint:#9aa4af;--paper:#14171a;--card:#1c2126;--grid:#30363d;--warn:#ff8a80;
--s0:#56b4e9;--s1:#ff8a3d;--s2:#2fc79a;--s3:#e08cc0;--s4:#f0c040;--s5:#9ccbe8;--p0:#7d8793;--p1:#e69f00;--p2:#56b4e9}
}*{box-sizing:border-box}body{margin:0 auto;max-width:80rem;padding:1.5rem;background:var(--paper);color:var(--ink);font:15px/1.5 system-ui,
sans-serif}h1{font-size:1.6rem;margin:0 0 .2rem}h2{font-size:1.15rem;margin:2rem 0 .5rem}p{margin:.3rem 0;max-width:60rem}
.faint{color:var(--faint)}.warn{color:var(--warn);font-weight:600}.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(26rem,1fr));
gap:1rem}.small{grid-template-columns:repeat(auto-fit,minmax(17rem,1fr))}figure{margin:0;padding:.8rem;background:var(--card);border-radius:.5rem;
break-inside:avoid}svg{width:100%;height:auto;display:block}figcaption{font-size:.85rem;color:var(--faint)}
text{fill:var(--ink);font:12px system-ui,sans-serif}.title{font-weight:600;font-size:14px}.axis{fill:var(--faint)}
.middle{text-anchor:middle}.end{text-anchor:end}text.small{font-size:10.5px}.label{font-weight:600}
.grid{stroke:var(--grid);stroke-width:1}.base{stroke:var(--faint);stroke-width:1}.line{fill:none;stroke-width:2}
.whisker{stroke-width:1.5;opacity:.6}.mark{stroke:var(--card);stroke-width:1}.line.s0,.whisker.s0{stroke:var(--s0)}
.line.s1,.whisker.s1{stroke:var(--s1)}.line.s2,.whisker.s2{stroke:var(--s2)}.line.s3,.whisker.s3{stroke:var(--s3)}
.line.s4,.whisker.s4{stroke:var(--s4)}.line.s5,.whisker.s5{stroke:var(--s5)}.mark.s0,.label.s0{fill:var(--s0)}
.mark.s1,.label.s1{fill:var(--s1)}.mark.s2,.label.s2{fill:var(--s2)}.mark.s3,.label.s3{fill:var(--s3)}
.mark.s4,.label.s4{fill:var(--s4)}.mark.s5,.label.s5{fill:var(--s5)}.p0{fill:var(--p0)}.p1{fill:var(--p1)}
.p2{fill:var(--p2)}.key{display:inline-block;margin-right:1.2rem;font-weight:600}.key svg{display:inline-block;width:12px;height:12px;
margin-right:.35rem;vertical-align:-1px}.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:.76rem;font-variant-numeric:tabular-nums}
th,td{padding:.2rem .38rem;text-align:right;border-bottom:1px solid var(--grid);white-space:nowrap}
th{color:var(--faint);font-weight:600;vertical-align:bottom}td.text,th.text{text-align:left}
td.wrap{white-space:normal;text-align:left}tr.first td{border-top:2px solid var(--grid)}td.best{font-weight:700}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.2rem 1rem;font-size:.9rem}dt{color:var(--faint)}
dd{margin:0;overflow-wrap:anywhere}pre{background:var(--card);padding:.8rem;border-radius:.5rem;overflow-x:auto;font-size:.85rem}
@media print{body{max-width:none;padding:0;font-size:11px}figure,pre{border:1px solid var(--grid)}
.scroll{overflow:visible}table{font-size:8px}th,td{padding:.15rem .3rem}}
)css";

}  // namespace rink::loadgen
