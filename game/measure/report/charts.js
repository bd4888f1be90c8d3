// Scatter charts of error against a cost: axes, points, bars, the front, and pointing at them.

const signs = [ // paths around 0, 0, of about equal area; colours go with them in style.css (.technique_N)
  "M-4.5,0a4.5,4.5 0 1,0 9,0a4.5,4.5 0 1,0 -9,0Z",
  "M-4,-4H4V4H-4Z",
  "M0,-5.4L5.2,3.8H-5.2Z",
  "M0,-5.8L5.8,0L0,5.8L-5.8,0Z",
  "M0,5.4L5.2,-3.8H-5.2Z",
  "M-1.7,-5.2H1.7V-1.7H5.2V1.7H1.7V5.2H-1.7V1.7H-5.2V-1.7H-1.7Z",
  "M0,-5.5L5.2,-1.7L3.2,4.5H-3.2L-5.2,-1.7Z",
];

function make_svg(svg, name, attributes, ...children) {
  const element = document.createElementNS(svg.namespaceURI, name);
  for (const [key, value] of Object.entries(attributes || {})) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

function make_sign(svg, technique, attributes) {
  const index = technique_index(technique) % signs.length;
  return make_svg(svg, "path", { d: signs[index], ...attributes, class: `sign technique_${index} ${attributes.class || ""}` });
}

// A sign in running text: legends and tables.
function make_sign_icon(technique) {
  const chart = document.getElementById("chart_ms");
  const icon = make_svg(chart, "svg", { viewBox: "-7 -7 14 14", class: "icon", "aria-hidden": "true" });
  icon.append(make_sign(icon, technique, {}));
  return icon;
}

// ---- axes ----

// Logarithmic when all is above 0 and spans more than a factor of 4: errors and costs are ratios then.
function make_scale(values, from, to) {
  const numbers = values.filter(Number.isFinite);
  const above = numbers.filter(value => value > 0);
  const low = above.reduce((a, b) => Math.min(a, b), Infinity), high = above.reduce((a, b) => Math.max(a, b), 0);
  if (high > 4 * low) {
    const first = Math.log10(low) - 0.04 * Math.log10(high / low), last = Math.log10(high) + 0.04 * Math.log10(high / low);
    return { log: true, first, last, place: value => from + (to - from) * Math.max(0, (Math.log10(Math.max(value, 1e-300)) - first) / (last - first)) };
  }
  const top = high > 0 ? 1.06 * high : 1;
  return { log: false, first: 0, last: top, place: value => from + (to - from) * Math.max(0, value) / top };
}

function list_ticks(scale) {
  const ticks = [];
  if (scale.log) {
    const steps = scale.last - scale.first > 3 ? [1] : scale.last - scale.first > 1.2 ? [1, 3] : [1, 2, 3, 5, 7];
    const every = Math.max(1, Math.ceil((scale.last - scale.first) / 6));
    for (let decade = Math.floor(scale.first); decade <= scale.last; decade += every)
      for (const step of steps) ticks.push(step * Math.pow(10, decade));
    return ticks.filter(tick => Math.log10(tick) >= scale.first && Math.log10(tick) <= scale.last);
  }
  const rough = scale.last / 5, power = Math.pow(10, Math.floor(Math.log10(rough)));
  const step = [1, 2, 5, 10].map(factor => factor * power).find(candidate => candidate >= rough);
  for (let index = 0; index * step <= scale.last; index++) ticks.push(index * step);
  return ticks;
}

function print_tick(value) {
  return Number(value.toPrecision(3)).toString();
}

function draw_axes(chart) {
  const { svg, x, y, box } = chart;
  const grid = make_svg(svg, "g", { class: "grid" }), labels = make_svg(svg, "g", { class: "ticks" });
  for (const tick of list_ticks(x)) {
    const place = x.place(tick);
    grid.append(make_svg(svg, "line", { x1: place, x2: place, y1: box.top, y2: box.bottom }));
    labels.append(make_svg(svg, "text", { x: place, y: box.bottom + 16, "text-anchor": "middle" }, print_tick(tick)));
  }
  for (const tick of list_ticks(y)) {
    const place = y.place(tick);
    grid.append(make_svg(svg, "line", { x1: box.left, x2: box.right, y1: place, y2: place }));
    labels.append(make_svg(svg, "text", { x: box.left - 6, y: place + 4, "text-anchor": "end" }, print_tick(tick)));
  }
  labels.append(make_svg(svg, "text", { x: box.right, y: box.bottom + 34, "text-anchor": "end", class: "axis" },
    chart.cost_label + (x.log ? ", log scale" : "")));
  labels.append(make_svg(svg, "text", { x: box.left, y: box.top - 8, "text-anchor": "start", class: "axis" },
    chart.error_label + (y.log ? ", log scale" : "")));
  svg.append(grid, make_svg(svg, "path", { class: "frame", d: `M${box.left},${box.top}V${box.bottom}H${box.right}` }), labels);
}

// ---- marks ----

// From the cheapest point on the front, the least error to be had for a cost: down only where a point allows it.
function draw_front(chart, front) {
  if (front.length === 0) return;
  const points = front.map(row => [chart.x.place(chart.cost_of(row)), chart.y.place(chart.error_of(row))]);
  let d = `M${points[0][0]},${chart.box.top}`;
  for (const [px, py] of points) d += `H${px}V${py}`;
  chart.svg.append(make_svg(chart.svg, "path", { class: "front", d: d + `H${chart.box.right}` }));
}

function draw_screen_line(chart, screen_error) {
  if (!Number.isFinite(screen_error) || screen_error <= 0) return;
  const place = chart.y.place(screen_error);
  if (place < chart.box.top) return;
  chart.svg.append(make_svg(chart.svg, "line", { class: "screen_line", x1: chart.box.left, x2: chart.box.right, y1: place, y2: place }),
    make_svg(chart.svg, "text", { class: "screen_label", x: chart.box.right, y: place - 4, "text-anchor": "end" }, "rays that see only the depth buffer"));
}

function draw_points(chart, pinned) {
  const bars = make_svg(chart.svg, "g", { class: "bars" }), points = make_svg(chart.svg, "g", {});
  for (const point of chart.points) {
    const row = point.row;
    if (chart.cost_key === "ms" && row.ms_max > row.ms_min)
      bars.append(make_svg(chart.svg, "line", { x1: chart.x.place(row.ms_min), x2: chart.x.place(row.ms_max), y1: point.y, y2: point.y }));
    points.append(make_sign(chart.svg, row.technique, { transform: `translate(${point.x},${point.y}) scale(${row.initial ? 1.5 : 1})`, class: row.initial ? "initial" : "" }));
    if (pinned.includes(row.setting))
      points.append(make_svg(chart.svg, "circle", { class: "ring", cx: point.x, cy: point.y, r: 10.5 }));
  }
  chart.svg.append(bars, points);
}

// options: rows, cost_key, cost_label, error (a column), pinned (settings), screen_error (of exact rays that see only the depth buffer, or NaN)
function draw_chart(svg, options) {
  const width = Math.max(svg.clientWidth, 240), height = Math.max(svg.clientHeight, 240);
  const box = { left: 56, right: width - 14, top: 26, bottom: height - 42 };
  const error_of = row => options.error.of(row[options.error.key]);
  const cost_of = row => row[options.cost_key];
  const shown = options.rows.filter(row => Number.isFinite(cost_of(row)) && Number.isFinite(error_of(row)));
  const costs = options.cost_key === "ms" ? shown.flatMap(row => [row.ms, row.ms_min, row.ms_max]) : shown.map(cost_of);
  const chart = {
    svg, box, error_of, cost_of, cost_key: options.cost_key, cost_label: options.cost_label, error_label: error_label(options.error),
    x: make_scale(costs, box.left, box.right), y: make_scale([...shown.map(error_of), options.screen_error], box.bottom, box.top),
  };
  chart.points = shown.map(row => ({ row, x: chart.x.place(cost_of(row)), y: chart.y.place(error_of(row)) })).sort((a, b) => a.x - b.x || a.y - b.y);
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.replaceChildren();
  if (shown.length === 0) {
    svg.append(make_svg(svg, "text", { x: width / 2, y: height / 2, "text-anchor": "middle", class: "axis" }, "no measurements to show"));
    return chart;
  }
  draw_axes(chart);
  draw_screen_line(chart, options.screen_error);
  draw_front(chart, find_front(shown, cost_of, error_of));
  draw_points(chart, options.pinned);
  chart.pointer = make_svg(svg, "circle", { class: "pointer", r: 13, visibility: "hidden" });
  svg.append(chart.pointer);
  return chart;
}

// ---- pointing ----

const pointing_reach = 26; // pixels

function nearest_point(chart, event) {
  const frame = chart.svg.getBoundingClientRect();
  const px = event.clientX - frame.left, py = event.clientY - frame.top;
  let best = null, best_distance = pointing_reach;
  for (const point of chart.points) {
    const distance = Math.hypot(point.x - px, point.y - py);
    if (distance < best_distance) [best, best_distance] = [point, distance];
  }
  return best;
}

function show_pointer(chart, row) {
  if (!chart || !chart.pointer) return null;
  const point = row && chart.points.find(candidate => candidate.row === row);
  chart.pointer.setAttribute("visibility", point ? "visible" : "hidden");
  if (point) {
    chart.pointer.setAttribute("cx", point.x);
    chart.pointer.setAttribute("cy", point.y);
  }
  return point;
}

function describe_numbers(row) {
  return ["ms", "fetches", "rmse", "bias", "p99", "max", "ssim", "screen_rmse", "noise", "flicker", "instability"].map(key => {
    const column = column_of.get(key);
    const range = key === "ms" && row.ms_max > row.ms_min ? ` (${three_digits(row.ms_min)} to ${three_digits(row.ms_max)})` : "";
    return [column.of_label && !["bias", "ssim"].includes(key) ? column.of_label : column.label, print_value(column, row) + range];
  });
}

function show_tooltip(chart, point) {
  const tooltip = document.getElementById("tooltip");
  tooltip.hidden = !point;
  if (!point) return;
  const list = make_element("dl", {});
  for (const [name, value] of describe_numbers(point.row)) list.append(make_element("dt", {}, name), make_element("dd", {}, value));
  tooltip.replaceChildren(make_element("p", {}, make_sign_icon(point.row.technique), make_element("code", {}, point.row.setting),
    point.row.initial ? " as it comes" : ""), list);
  const frame = chart.svg.getBoundingClientRect();
  const left = frame.left + point.x + 16, width = tooltip.offsetWidth, height = tooltip.offsetHeight;
  const fits = left + width < document.documentElement.clientWidth - 8;
  tooltip.style.left = `${window.scrollX + Math.max(8, fits ? left : frame.left + point.x - 16 - width)}px`;
  tooltip.style.top = `${window.scrollY + Math.max(8, Math.min(frame.top + point.y - height / 2, window.innerHeight - height - 8))}px`;
}

// charts(): those drawn last, by the id of their element; pin(row) is what a click and Enter do.
function listen_to_chart(svg, charts, pin) {
  const point_at = point => {
    for (const chart of Object.values(charts())) show_pointer(chart, point && point.row);
    show_tooltip(charts()[svg.id], point);
    svg.classList.toggle("pointing", Boolean(point));
  };
  let focused = -1;
  svg.addEventListener("pointermove", event => point_at(nearest_point(charts()[svg.id], event)));
  svg.addEventListener("pointerleave", () => point_at(null));
  svg.addEventListener("blur", () => point_at(null));
  svg.addEventListener("click", event => {
    const point = nearest_point(charts()[svg.id], event);
    if (point) pin(point.row);
  });
  svg.addEventListener("keydown", event => {
    const points = charts()[svg.id].points;
    const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (step && points.length) {
      focused = focused < 0 ? (step > 0 ? 0 : points.length - 1) : (focused + step + points.length) % points.length;
      point_at(points[focused]);
      document.getElementById("spoken").textContent = points[focused].row.setting + ": " +
        describe_numbers(points[focused].row).slice(0, 4).map(pair => pair.join(" ")).join(", ");
    } else if (event.key === "Enter" && points[focused]) {
      pin(points[focused].row);
    } else if (event.key === "Escape") {
      focused = -1;
      point_at(null);
    } else {
      return;
    }
    event.preventDefault();
  });
}
