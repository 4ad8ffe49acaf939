/* Colour maps of values. */

const MAPS = {
  // Matplotlib's viridis (CC0): its lightness rises evenly, also for the colour-blind.
  viridis:
    "440154470d6048186a482374472d7b4537814240863e49893b528b375b8d33638d2f6b8e2c728e297a8e26828e" +
    "23898e21918c1f988b1fa08822a78528ae8032b67a3fbc734ec36b5ec96270cf5784d44b98d83eaddc30c2df23" +
    "d8e219ece51bfde725",
  // Google's turbo (Apache 2.0): more shades, but not even.
  turbo:
    "30123b392a734040a24456c7466be34680f64294ff37a8fa28bceb1ccdd818ddc21fe9af32f2984ef97d6dfe62" +
    "8bff4ba4fc3cb9f635cdec34dfdf37eecf3af8be39fdac34fe962bfb7e21f46617eb500edf3f08d02f05be2102" +
    "a91601920b017a0403",
};

export const MAP_NAMES = Object.keys(MAPS);

/** 256 colours as RGBA bytes. */
export function mapBytes(name, reverse = false) {
  const text = MAPS[name];
  if (!text) throw new Error(`There is no colour map “${name}”: ${MAP_NAMES.join(", ")}.`);
  const count = text.length / 6;
  const part = (stop, channel) => parseInt(text.substr(6 * stop + 2 * channel, 2), 16);
  const bytes = new Uint8Array(1024);
  for (let i = 0; i < 256; i += 1) {
    const at = ((reverse ? 255 - i : i) / 255) * (count - 1);
    const stop = Math.min(Math.floor(at), count - 2);
    for (let channel = 0; channel < 3; channel += 1) {
      const [from, to] = [part(stop, channel), part(stop + 1, channel)];
      bytes[4 * i + channel] = Math.round(from + (to - from) * (at - stop));
    }
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}

/** The map as a CSS gradient in the given direction. */
export function mapGradient(bytes, direction) {
  const stops = [];
  for (let i = 0; i <= 16; i += 1) {
    const at = 4 * Math.round((i * 255) / 16);
    stops.push(`rgb(${bytes[at]} ${bytes[at + 1]} ${bytes[at + 2]})`);
  }
  return `linear-gradient(${direction}, ${stops.join(", ")})`;
}

/** Round numbers from `low` to `high`, about `count` of them. */
export function niceTicks(low, high, count = 5) {
  if (!(high > low)) return [low];
  const step = niceStep((high - low) / count);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1) ticks.push(i * step);
  return ticks;
}

/** The nearest of 1, 2, 5 times a power of ten that is not smaller. */
export function niceStep(rough) {
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= rough * (1 - 1e-9));
}

/** A number with as many digits as its scale of `span` needs. */
export function shortNumber(value, span) {
  const digits = Math.min(Math.max(0, 2 - Math.floor(Math.log10(span || Math.abs(value) || 1))), 8);
  const text = Number(value.toFixed(digits)).toString();
  return text.replace("-", "−");
}
