// What a reader of a report would complain about, found by the browser that shows it: `findings_of(window)` is a list of sentences, beside what was looked at.

const selector_of_marks = '.mark,.dot,.bar,.line,.box';
const margin = 10;  // [user units] around a picture: its file has it (loadgen/report/plots/picture.cpp), and the page's cards have more padding

/// Red, green and blue from 0 to 1, and opacity.
function rgba(text) {
  const numbers = text.match(/[\d.]+/g).map(Number);
  return [numbers[0] / 255, numbers[1] / 255, numbers[2] / 255, numbers.length > 3 ? numbers[3] : 1];
}

function luminance([red, green, blue]) {
  const linear = share => share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  return 0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue);
}

/// The ratio of WCAG 2.1, 1 to 21.
function contrast(one, other) {
  const [dark, light] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (light + 0.05) / (dark + 0.05);
}

/// The nearest colour that something is painted under `element`.
function background_of(window, element) {
  for (let place = element; place; place = place.parentElement) {
    const colour = rgba(window.getComputedStyle(place).backgroundColor);
    if (colour[3] > 0) return colour;
  }
  return [1, 1, 1, 1];
}

function overlap(one, other, least) {
  return Math.min(one.right, other.right) - Math.max(one.left, other.left) > least && Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top) > least;
}

/// How far [px] `inner` reaches beyond `outer`.
function beyond(inner, outer) {
  return Math.max(outer.left - inner.left, inner.right - outer.right, outer.top - inner.top, inner.bottom - outer.bottom);
}

/// The rectangle that data fill: the axis below, and the longest line that stands on it.
function frame_of(svg, scale) {
  const ends = selector => [...svg.querySelectorAll(selector)].map(line => ['x1', 'y1', 'x2', 'y2'].map(name => +line.getAttribute(name)));
  const longest = (all, length) => all.reduce((best, line) => length(line) > length(best) ? line : best, [0, 0, 0, 0]);
  const below = longest(ends('line.base').filter(([, y1, , y2]) => y1 === y2), ([x1, , x2]) => x2 - x1);
  const upright = longest(ends('line.base,line.grid').filter(([x1, , x2]) => x1 === x2), ([, y1, , y2]) => Math.abs(y2 - y1));
  const corner = svg.getBoundingClientRect();
  return {left: corner.left + scale * below[0], right: corner.left + scale * below[2], top: corner.top + scale * Math.min(upright[1], upright[3]), bottom: corner.top + scale * below[1]};
}

/// Samples beside the words of a legend are no data.
function is_in_legend(mark, legend, scale) {
  const box = mark.getBoundingClientRect(), middle = (box.top + box.bottom) / 2;
  return legend.some(words => middle > words.top && middle < words.bottom && box.left >= words.left - 34 * scale && box.right <= words.left);
}

function look_at_plot(window, svg, seen, say) {
  const title = svg.querySelector('.title')?.textContent ?? 'without a title', about = `plot "${title}" at ${window.innerWidth} px`;
  const scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width, outer = svg.getBoundingClientRect();
  const texts = [...svg.querySelectorAll('text')].map(text => ({element: text, words: text.textContent, box: text.getBoundingClientRect()}));
  for (const {element, words, box} of texts) {
    ++seen.texts;
    if (words && (!box.width || !box.height)) say(`unseen: "${words}" of ${about}`);
    if (beyond(box, outer) > margin * scale) say(`cut off: "${words}" of ${about} reaches ${beyond(box, outer).toFixed(1)} px beyond it`);
    const ratio = contrast(rgba(window.getComputedStyle(element).fill), background_of(window, element));
    seen.least_contrast = Math.min(seen.least_contrast, ratio);
    if (ratio < 3) say(`pale: "${words}" of ${about} has a contrast of ${ratio.toFixed(2)}`);
  }
  texts.forEach((one, i) => texts.slice(i + 1).forEach(other => {
    if (overlap(one.box, other.box, scale)) say(`overlap: "${one.words}" and "${other.words}" of ${about}`);
  }));
  const legend = texts.filter(({element}) => element.classList.contains('legend')).map(({box}) => box), frame = frame_of(svg, scale);
  let drawn = 0;
  for (const mark of svg.querySelectorAll(selector_of_marks)) {
    if (is_in_legend(mark, legend, scale)) continue;
    const box = mark.getBoundingClientRect(), style = window.getComputedStyle(mark), colour = style.fill === 'none' ? style.stroke : style.fill;
    if (!(box.width + box.height > 0)) continue;
    if (beyond(box, frame) > 8 * scale) say(`outside: a ${mark.getAttribute('class')} of ${about} lies ${beyond(box, frame).toFixed(1)} px beyond its frame`);
    const ratio = colour === 'none' ? 1 : contrast(rgba(colour), background_of(window, mark));
    seen.least_contrast_of_marks = Math.min(seen.least_contrast_of_marks, ratio);
    if (ratio < 1.5 || style.visibility !== 'visible' || +style.opacity === 0) say(`unseen: a ${mark.getAttribute('class')} of ${about} has a contrast of ${ratio.toFixed(2)}`);
    else ++drawn;
  }
  seen.marks += drawn;
  seen.plots.push(title);
  if (drawn === 0) say(`empty: ${about} has no mark`);
}

/// What is wider than the window and does not scroll inside a container of its own.
function look_at_width(window, say) {
  const root = window.document.documentElement;
  if (root.scrollWidth > window.innerWidth) say(`wide: the page is ${root.scrollWidth} px wide in a window of ${window.innerWidth} px`);
  const scrolls = element => ['auto', 'scroll'].includes(window.getComputedStyle(element).overflowX);
  for (const element of window.document.body.querySelectorAll('*')) {
    const about = `${element.tagName.toLowerCase()} "${element.textContent.trim().slice(0, 40)}" at ${window.innerWidth} px`;
    if (['hidden', 'clip'].includes(window.getComputedStyle(element).overflowX) && element.scrollWidth > element.clientWidth)
      say(`cut off: ${about} shows ${element.clientWidth} of ${element.scrollWidth} px`);
    if (element.getBoundingClientRect().right <= window.innerWidth + 0.5 || element.closest('svg')) continue;
    let container = element.parentElement;
    while (container && !scrolls(container)) container = container.parentElement;
    if (!container) say(`wide: ${about} ends at ${element.getBoundingClientRect().right.toFixed(1)} px`);
  }
}

function look_at_words(window, seen, say) {
  for (const element of window.document.body.querySelectorAll('*')) {
    if (element.closest('svg,script,style') || ![...element.childNodes].some(node => node.nodeType === 3 && node.data.trim())) continue;
    ++seen.texts;
    const ratio = contrast(rgba(window.getComputedStyle(element).color), background_of(window, element));
    seen.least_contrast = Math.min(seen.least_contrast, ratio);
    if (ratio < 3) say(`pale: "${element.textContent.trim().slice(0, 40)}" has a contrast of ${ratio.toFixed(2)}`);
  }
}

function findings_of(window) {
  for (const folded of window.document.querySelectorAll('details')) folded.open = true;
  const seen = {width: window.innerWidth, is_dark: window.matchMedia('(prefers-color-scheme: dark)').matches, paper: window.getComputedStyle(window.document.body).backgroundColor, plots: [],
                texts: 0, marks: 0, least_contrast: 21, least_contrast_of_marks: 21, findings: [...(window.said ?? ['error: nobody listened'])]};
  const say = sentence => seen.findings.push(sentence);
  look_at_width(window, say);
  look_at_words(window, seen, say);
  for (const svg of window.document.querySelectorAll('svg')) look_at_plot(window, svg, seen, say);
  return seen;
}
