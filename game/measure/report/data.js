// The results: rows, the sites they were measured at, sums over cameras, fronts.

const report = JSON.parse(document.getElementById("results").textContent);
const rows = report.rows;
const reference_technique = "reference"; // its rows are truths, not choices

function make_element(name, attributes, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (value === true) element.setAttribute(key, "");
    else if (value !== false && value !== null) element.setAttribute(key, value);
  }
  element.append(...children.filter(child => child !== null));
  return element;
}

function unique(values) {
  return [...new Set(values)];
}

function describe_r_max(row) {
  const part = row.r_max_part > 0 ? ` (${Number(row.r_max_part.toPrecision(3))} of the diagonal)` : "";
  return `${Number(row.r_max.toPrecision(3))} m${part}`;
}

function describe_size(row) {
  return `${row.width} x ${row.height}`;
}

// What is computed, as against where from: r_max, falloff and size.
function describe_reach(row) {
  return [describe_r_max(row), row.falloff, describe_size(row)].join(", ");
}

// One name with changed content is another scene.
const hashes_of = new Map();
for (const row of rows) hashes_of.set(row.scene, (hashes_of.get(row.scene) || new Set()).add(row.scene_hash));
for (const place of [...rows, ...report.sites].filter(place => (hashes_of.get(place.scene) || []).size > 1))
  place.scene += ` (content ${place.scene_hash.slice(0, 4)})`;

// Times of two machines, or of two builds, have nothing to do with each other: where there are several, each is a reach of its own.
const origin_of = row => row.machine + "\n" + row.build;
const origins = unique(rows.map(origin_of));

function describe_origin(row) {
  return origins.length > 1 ? [`origin ${origins.indexOf(origin_of(row)) + 1}: ${row.machine}, build ${row.build.slice(0, 4)}`] : [];
}

const many_falloffs = unique(rows.map(row => row.falloff)).length > 1, many_sizes = unique(rows.map(describe_size)).length > 1;

function place_key(place) {
  return [place.scene_hash, place.r_max, place.falloff, place.width, place.height, place.camera].join("\n");
}

function reach_key(row) {
  return [row.r_max, row.falloff, row.width, row.height, origins.indexOf(origin_of(row))].join(" ");
}

for (const [index, row] of rows.entries()) {
  row.index = index;
  for (const [column, number] of report.columns.entries())
    row[number.key] = row.numbers[column] === null ? NaN : row.numbers[column];
  row.reach = [describe_reach(row), ...describe_origin(row)].join(", ");
  row.short_reach = [describe_r_max(row), ...(many_falloffs ? [row.falloff] : []), ...(many_sizes ? [describe_size(row)] : []), ...describe_origin(row).map(text => text.split(":")[0])].join(", ");
  row.reach_key = reach_key(row);
  row.view = row.scene + "\n" + row.reach_key;
  row.words = [row.setting, row.scene, row.camera, row.reach].join(" ").toLowerCase();
}

// Nook's own first and always in this order, so that signs and colours are the same in every report.
const familiar_techniques = ["volume", "gtao", "hbao", "ssao", "hsao"];
const techniques = unique([...familiar_techniques, ...rows.map(row => row.technique)]).filter(technique => rows.some(row => row.technique === technique));

function technique_index(technique) {
  const index = familiar_techniques.indexOf(technique);
  return index >= 0 ? index : familiar_techniques.length + techniques.filter(other => !familiar_techniques.includes(other)).indexOf(technique);
}

const site_of = new Map(report.sites.map(site => [place_key(site), site]));

function site_of_row(row) {
  return site_of.get(place_key(row));
}

// One number for several cameras: their mean, RMS or largest; cameras without one are left out.
function over_cameras(how, values) {
  const numbers = values.filter(Number.isFinite);
  if (numbers.length === 0) return NaN;
  if (how === "largest") return numbers.reduce((a, b) => Math.max(a, b));
  if (how === "rms") return Math.sqrt(numbers.reduce((sum, value) => sum + value * value, 0) / numbers.length);
  return numbers.reduce((sum, value) => sum + value, 0) / numbers.length;
}

function sum_up(group) {
  const sum = { ...group[0], camera: group.length === 1 ? group[0].camera : `${group.length} cameras`, picture: "", cameras: group.length };
  for (const number of report.columns) sum[number.key] = over_cameras(number.over, group.map(row => row[number.key]));
  return sum;
}

// The rows of a scene and reach at one camera; "" is all cameras, each setting summed up over them.
function rows_of_view(scene, reach, camera) {
  const found = rows.filter(row => row.scene === scene && row.reach_key === reach && (camera === "" || row.camera === camera));
  if (camera !== "") return found;
  const groups = new Map();
  for (const row of found) groups.set(row.setting, [...(groups.get(row.setting) || []), row]);
  const sums = [...groups.values()].map(sum_up);
  const most = sums.reduce((cameras, sum) => Math.max(cameras, sum.cameras), 0);
  return sums.filter(sum => sum.cameras === most); // others would be held against different pictures
}

// The rows that no other beats in both, from cheap to dear. Of equal ones all stand on it.
function find_front(candidates, cost_of, error_of) {
  const points = candidates
    .filter(row => row.technique !== reference_technique && Number.isFinite(cost_of(row)) && Number.isFinite(error_of(row)))
    .sort((a, b) => cost_of(a) - cost_of(b) || error_of(a) - error_of(b));
  const front = [];
  for (const row of points) {
    const best = front[front.length - 1];
    if (!best || error_of(row) < error_of(best) || (error_of(row) === error_of(best) && cost_of(row) === cost_of(best))) front.push(row);
  }
  return front;
}

// row.front for every row: at its own scene, camera and reach, in the chosen error.
function mark_fronts(error_of) {
  const places = new Map();
  for (const row of rows) {
    const place = row.view + "\n" + row.camera;
    if (!places.has(place)) places.set(place, []);
    places.get(place).push(row);
    row.front = "";
  }
  for (const group of places.values()) {
    for (const row of find_front(group, row => row.ms, error_of)) row.front = "ms";
    for (const row of find_front(group, row => row.fetches, error_of)) row.front = row.front ? "both" : "fetches";
  }
}
