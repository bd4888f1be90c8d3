// Pictures: from the base64 in the file to pixels, and from two of them to signed errors.

const pictures_kept = 24; // decoded ones; each takes four bytes a pixel
const picture_elements = new Map([...document.querySelectorAll("script[data-picture]")].map(element => [element.dataset.picture, element]));
const decoded = new Map();

function has_picture(name) {
  return picture_elements.has(name);
}

async function decode_picture(name) {
  const image = new Image();
  image.src = "data:image/png;base64," + picture_elements.get(name).textContent;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = image.naturalWidth;
  canvas.height = image.naturalHeight;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, canvas.width, canvas.height);
}

// A promise of its ImageData. Grey ones hold round(255 visibility) in each channel.
function read_picture(name) {
  const found = decoded.get(name) || decode_picture(name);
  decoded.delete(name);
  decoded.set(name, found); // the last used one goes last
  if (decoded.size > pictures_kept) decoded.delete(decoded.keys().next().value);
  return found;
}

// ---- colours of errors: the same as modules/measure/colour_map.c, whose comments say why ----

function encode_srgb(linear) {
  const x = Math.min(Math.max(linear, 0), 1);
  return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * Math.pow(x, 1 / 2.4) - 0.055));
}

// Ottosson, "A perceptual color space for image processing", 2020.
function srgb_of_oklab(lightness, a, b) {
  const l = Math.pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const m = Math.pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const s = Math.pow(lightness - 0.0894841775 * a - 1.291485548 * b, 3);
  return [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s].map(encode_srgb);
}

// [red, green, blue]: + is too bright and blue, - too dark and red.
function error_colour(error, range) {
  const t = Math.min(Math.abs(error) / range, 1);
  const chroma = 0.155 * (1 - (1 - t) * (1 - t));
  const hue = error < 0 ? 0.47 : 4.5;
  return srgb_of_oklab(0.97 + (0.4 - 0.97) * t, chroma * Math.cos(hue), chroma * Math.sin(hue));
}

const no_geometry_colour = [200, 200, 200];

// All 511 differences that two 8-bit pictures can have, as pixels.
function make_error_colours(range) {
  const colours = new Uint8ClampedArray(4 * 511);
  for (let difference = -255; difference <= 255; difference++)
    colours.set([...error_colour(difference / 255, range), 255], 4 * (difference + 255));
  return colours;
}

function same_size(a, b) {
  return a.width === b.width && a.height === b.height;
}

// The signed error of each pixel as ImageData. mask: null is geometry everywhere. Pictures that do not fit together give null.
function make_error_map(picture, truth, mask, range) {
  if (!same_size(picture, truth) || (mask && !same_size(picture, mask))) return null;
  const colours = make_error_colours(range);
  const map = new ImageData(picture.width, picture.height);
  for (let i = 0; i < map.data.length; i += 4) {
    if (mask && mask.data[i] === 0) {
      map.data.set(no_geometry_colour, i);
      map.data[i + 3] = 255;
    } else {
      const colour = 4 * (picture.data[i] - truth.data[i] + 255);
      for (let channel = 0; channel < 4; channel++) map.data[i + channel] = colours[colour + channel];
    }
  }
  return map;
}

// RMSE, bias, MAE, p99 and max of two 8-bit pictures where there is geometry; null when they do not fit together.
function measure_errors(picture, truth, mask) {
  if (!same_size(picture, truth) || (mask && !same_size(picture, mask))) return null;
  const counts = new Float64Array(256); // by absolute difference
  let sum = 0, count = 0;
  for (let i = 0; i < picture.data.length; i += 4) {
    if (mask && mask.data[i] === 0) continue;
    const difference = picture.data[i] - truth.data[i];
    counts[Math.abs(difference)]++;
    sum += difference;
    count++;
  }
  if (count === 0) return null;
  let squares = 0, absolute = 0, max = 0, p99 = NaN, seen = 0;
  for (let size = 0; size < 256; size++) {
    squares += size * size * counts[size];
    absolute += size * counts[size];
    seen += counts[size];
    if (counts[size]) max = size;
    if (Number.isNaN(p99) && seen >= Math.ceil(0.99 * count)) p99 = size;
  }
  return { rmse: Math.sqrt(squares / count) / 255, bias: sum / count / 255, mae: absolute / count / 255, p99: p99 / 255, max: max / 255 };
}

function show_picture(canvas, data) {
  canvas.width = data ? data.width : 1;
  canvas.height = data ? data.height : 1;
  if (data) canvas.getContext("2d").putImageData(data, 0, 0);
}

function read_site_picture(site, which) {
  return site && has_picture(site[which]) ? read_picture(site[which]) : null;
}
