// The look of the report and of its pictures: light, dark and print.
#pragma once

#include <string>

namespace rink::loadgen {

/// CSS. Line colours are Okabe and Ito's colour-blind-safe set (2008), darkened for white paper and
/// lightened for the dark page; s0 to s7 are lines, d0 to d3 dashes, p0 to p3 the parts of a bar.
inline constexpr const char* light_colours =
    R"css(--ink:#1b1f24;--faint:#59636e;--paper:#fff;--card:#f6f8fa;--grid:#dfe3e8;--warn:#b3261e;--link:#0b5cad;--s0:#0072b2;--s1:#c24e00;--s2:#007a58;--s3:#b3498a;--s4:#8a5d00;--s5:#5b6470;--s6:#6a51a3;--s7:#1b1f24;--p0:#8a94a0;--p1:#e69f00;--p2:#56b4e9;--p3:#b3498a)css";

/// The page's rules before those of pictures: colours in the dark, texts and boxes.
inline constexpr const char* page_style = R"css(
@media screen and (prefers-color-scheme:dark){:root{--ink:#e6e9ec;--faint:#9aa4af;--paper:#14171a;--card:#1c2126;--grid:#30363d;--warn:#ff8a80;
--link:#7fbcf5;--s0:#56b4e9;--s1:#ff8a3d;--s2:#2fc79a;--s3:#e08cc0;--s4:#f0c040;--s5:#b4bcc6;--s6:#b9a3ea;--s7:#f4f4f4;--p0:#7d8793;--p1:#e69f00;--p2:#56b4e9;--p3:#e08cc0}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:80rem;padding:1.5rem;background:var(--paper);color:var(--ink);font:15px/1.5 system-ui,sans-serif}
h1{font-size:1.6rem;line-height:1.25;margin:0 0 .4rem;overflow-wrap:anywhere}h2{font-size:1.2rem;margin:2.2rem 0 .5rem}h3{font-size:1rem;margin:1.2rem 0 .3rem}
p{margin:.3rem 0;max-width:60rem;overflow-wrap:anywhere}.headline{font-size:1.1rem;font-weight:600}.faint{color:var(--faint)}.warn{color:var(--warn);font-weight:600}
nav{margin:.8rem 0;line-height:1.9}a{color:var(--link)}
.plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(30rem,100%),1fr));gap:1rem;align-items:start;margin:.6rem 0}
.small{grid-template-columns:repeat(auto-fill,minmax(min(22rem,100%),1fr))}
figure{margin:0;padding:.8rem;background:var(--card);border-radius:.5rem;break-inside:avoid;min-width:0}
svg{width:100%;max-width:44rem;height:auto;display:block;overflow:visible}figcaption{font-size:.85rem;color:var(--faint);margin-top:.3rem}
)css";

/// The rules of pictures, on the page and as files of their own: each class that they use has one
/// here.
inline constexpr const char* picture_style = R"css(
text{fill:var(--ink);font:12px system-ui,sans-serif}.title{font-weight:600;font-size:14px}.axis,.note{fill:var(--faint)}.note{font-size:10.5px}
.middle{text-anchor:middle}.end{text-anchor:end}.tick,.legend{font-variant-numeric:tabular-nums}
.grid{stroke:var(--grid);stroke-width:1}.base{stroke:var(--faint);stroke-width:1}.reference{fill:none;stroke:var(--faint);stroke-width:1;opacity:.45}
.mark-line{stroke:var(--warn);stroke-width:1.5;stroke-dasharray:6 4}
.line{fill:none;stroke-width:2;stroke-linejoin:round}.whisker{fill:none;stroke-width:1.3;opacity:.75}.mark,.dot{stroke:var(--card);stroke-width:1}
.box{fill-opacity:.18;stroke-width:1.2}.median{stroke-width:2.4}.dot{stroke-width:.6;fill-opacity:.85}
.d0{stroke-dasharray:none}.d1{stroke-dasharray:7 4}.d2{stroke-dasharray:2 3}.d3{stroke-dasharray:6 2 1.5 2}
.line.s0,.whisker.s0,.box.s0,.median.s0{stroke:var(--s0)}.line.s1,.whisker.s1,.box.s1,.median.s1{stroke:var(--s1)}
.line.s2,.whisker.s2,.box.s2,.median.s2{stroke:var(--s2)}.line.s3,.whisker.s3,.box.s3,.median.s3{stroke:var(--s3)}
.line.s4,.whisker.s4,.box.s4,.median.s4{stroke:var(--s4)}.line.s5,.whisker.s5,.box.s5,.median.s5{stroke:var(--s5)}
.line.s6,.whisker.s6,.box.s6,.median.s6{stroke:var(--s6)}.line.s7,.whisker.s7,.box.s7,.median.s7{stroke:var(--s7)}
.mark.s0,.dot.s0,.box.s0{fill:var(--s0)}.mark.s1,.dot.s1,.box.s1{fill:var(--s1)}.mark.s2,.dot.s2,.box.s2{fill:var(--s2)}
.mark.s3,.dot.s3,.box.s3{fill:var(--s3)}.mark.s4,.dot.s4,.box.s4{fill:var(--s4)}.mark.s5,.dot.s5,.box.s5{fill:var(--s5)}
.mark.s6,.dot.s6,.box.s6{fill:var(--s6)}.mark.s7,.dot.s7,.box.s7{fill:var(--s7)}
.bar{stroke:none}.p0{fill:var(--p0)}.p1{fill:var(--p1)}.p2{fill:var(--p2)}.p3{fill:var(--p3)}
)css";

/// The page's rules after those of pictures: tables and print.
inline constexpr const char* page_style_below = R"css(
.data{font-size:.85rem;color:var(--faint);margin-top:.4rem}summary{cursor:pointer}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:.8rem;font-variant-numeric:tabular-nums}
th,td{padding:.2rem .4rem;text-align:right;border-bottom:1px solid var(--grid);white-space:nowrap}
th{color:var(--faint);font-weight:600;vertical-align:bottom}td.text,th.text{text-align:left}td.wrap{white-space:normal;text-align:left;overflow-wrap:anywhere}
.wide th{white-space:normal}tr.first td{border-top:2px solid var(--grid)}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.2rem 1rem;font-size:.9rem}dt{color:var(--faint)}dd{margin:0;overflow-wrap:anywhere}
pre{background:var(--card);padding:.8rem;border-radius:.5rem;overflow-x:auto;font-size:.85rem}
@media (max-width:34rem){body{padding:.8rem}dl{grid-template-columns:1fr}dd{margin-bottom:.4rem}figure{padding:.5rem}}
@media print{:root{color-scheme:light;font-size:11px}section>p{break-after:avoid}body{max-width:none;padding:0;font-size:11px}nav,summary::marker{display:none}h2,h3{break-after:avoid}
.plots{grid-template-columns:1fr 1fr;gap:.6rem}.plots.small{grid-template-columns:1fr 1fr 1fr}figure,pre{border:1px solid var(--grid)}svg{max-width:100%}tr{break-inside:avoid}thead{display:table-header-group}
.scroll{overflow:visible}table{font-size:8px}.wide{font-size:6px}th,td{padding:.12rem .22rem}pre{white-space:pre-wrap}.mark-line,.line,rect,.mark,.dot{print-color-adjust:exact}}
)css";

/// The whole style sheet.
inline std::string report_style() {
  return std::string("\n:root{color-scheme:light dark;") + light_colours + "}" + page_style +
         picture_style + page_style_below;
}

}  // namespace rink::loadgen
