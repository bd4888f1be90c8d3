// The table of all rows: sorted by a click or a key on a header, filtered, and drawn in pieces so that thousands of rows stay quick.

const table_piece = 120; // rows drawn at a time; more come when the end is scrolled to

const table_view = { sorted_by: null, descending: false, groups: new Set(column_groups.map(group => group.key)), shown: [], rows: [], drawn: 0 };

const text_order = new Intl.Collator("en", { numeric: true }); // rays=8 before rays=16

function compare_cells(column, a, b) {
  if (column.text) return text_order.compare(a[column.key], b[column.key]);
  return a[column.key] - b[column.key];
}

// Rows without a number go last, whichever way it is sorted; equal ones keep their order.
function sort_rows(list) {
  const column = column_of.get(table_view.sorted_by);
  if (!column) return list;
  const has = row => column.text || Number.isFinite(row[column.key]);
  const sign = table_view.descending ? -1 : 1;
  return [...list].sort((a, b) => has(b) - has(a) || (has(a) ? sign * compare_cells(column, a, b) : 0));
}

function filter_rows(choice) {
  const scope = document.getElementById("table_scope").value;
  const technique = document.getElementById("table_technique").value;
  const words = document.getElementById("table_text").value.toLowerCase().split(/\s+/).filter(Boolean);
  return rows.filter(row => (technique === "" || row.technique === technique) &&
    (scope === "all" || row.scene === choice.scene) &&
    (scope !== "view" || (row.reach_key === choice.reach && (choice.camera === "" || row.camera === choice.camera))) &&
    words.every(word => row.words.includes(word)));
}

// Those of the chosen groups; of the places only what the rows differ in.
function shown_columns(found) {
  return columns.filter(column => table_view.groups.has(column.group) &&
    (column.group !== "place" || found.some(row => row[column.key] !== found[0][column.key])));
}

function make_header_cell(column, sort) {
  const sorted = table_view.sorted_by === column.key;
  const direction = sorted ? (table_view.descending ? "descending" : "ascending") : null;
  return make_element("th", { scope: "col", class: column.text ? "text" : "number", "aria-sort": direction, title: column.about, "data-key": column.key },
    make_element("button", { type: "button", "aria-describedby": "about_" + column.key, onclick: () => sort(column.key) }, column.label));
}

function make_header(shown, sort) {
  const groups = column_groups.filter(group => shown.some(column => column.group === group.key))
    .map(group => make_element("th", { colspan: shown.filter(column => column.group === group.key).length, scope: "colgroup" }, group.label));
  return make_element("thead", {}, make_element("tr", { class: "groups" }, ...groups),
    make_element("tr", { class: "columns" }, ...shown.map(column => make_header_cell(column, sort))));
}

function make_table_row(row, shown, go) {
  const cells = shown.map(column => {
    if (column.key === "setting")
      return make_element("th", { scope: "row" }, make_element("button", { type: "button", class: "plain", title: "show and pin", onclick: () => go(row) },
        make_sign_icon(row.technique), make_element("code", {}, row.setting)), row.initial ? make_element("span", { class: "tag" }, "as it comes") : null);
    return make_element("td", { class: column.text ? "text" : "number" }, print_value(column, row));
  });
  return make_element("tr", { class: (row.initial ? "initial " : "") + (row.front ? "on_front" : "") }, ...cells);
}

function draw_more_rows(go) {
  const piece = table_view.rows.slice(table_view.drawn, table_view.drawn + table_piece);
  document.querySelector("#table tbody").append(...piece.map(row => make_table_row(row, table_view.shown, go)));
  table_view.drawn += piece.length;
}

// go(row) is what a click on a row's setting does.
function draw_table(choice, go) {
  const sort = key => {
    table_view.descending = table_view.sorted_by === key && !table_view.descending;
    table_view.sorted_by = key;
    draw_table(choice, go);
    document.querySelector(`#table th[data-key="${key}"] button`).focus({ preventScroll: true });
  };
  const found = filter_rows(choice);
  table_view.rows = sort_rows(found);
  table_view.shown = shown_columns(found);
  table_view.drawn = 0;
  document.getElementById("table_count").textContent = `${found.length} of ${rows.length} rows`;
  document.getElementById("table").replaceChildren(make_header(table_view.shown, sort), make_element("tbody", {}));
  draw_more_rows(go);
}

function make_group_choice(group, redraw) {
  const box = make_element("input", { type: "checkbox", checked: true });
  box.addEventListener("change", () => {
    if (box.checked) table_view.groups.add(group.key);
    else table_view.groups.delete(group.key);
    redraw();
  });
  return make_element("label", {}, box, group.label);
}

// choice(): the scene, reach and camera chosen now.
function prepare_table(choice, go) {
  const redraw = () => draw_table(choice(), go);
  const select = document.getElementById("table_technique");
  select.append(new Option("all", ""), ...techniques.map(technique => new Option(technique, technique)));
  for (const id of ["table_scope", "table_technique"]) document.getElementById(id).addEventListener("change", redraw);
  document.getElementById("table_text").addEventListener("input", redraw);
  document.getElementById("table_groups").append(...column_groups.filter(group => !group.always).map(group => make_group_choice(group, redraw)));
  const scroll = document.getElementById("table_scroll");
  scroll.addEventListener("scroll", () => {
    if (table_view.drawn < table_view.rows.length && scroll.scrollTop + 2 * scroll.clientHeight > scroll.scrollHeight) draw_more_rows(go);
  });
  window.addEventListener("beforeprint", () => {
    while (table_view.drawn < table_view.rows.length) draw_more_rows(go);
  });
}
