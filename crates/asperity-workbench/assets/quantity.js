// Quantities as texts with units, for sliders. What a text means is the server's to say.

const UNITS = {
  length: { m: 1, cm: 1e-2, mm: 1e-3, um: 1e-6, µm: 1e-6, nm: 1e-9, pm: 1e-12, Å: 1e-10 },
  pressure: { Pa: 1, kPa: 1e3, MPa: 1e6, GPa: 1e9, bar: 1e5 },
  force: { N: 1, mN: 1e-3, uN: 1e-6, µN: 1e-6, kN: 1e3 },
  area: { m2: 1, "m²": 1, "m^2": 1, cm2: 1e-4, "cm²": 1e-4, "cm^2": 1e-4, mm2: 1e-6, "mm²": 1e-6, "mm^2": 1e-6, um2: 1e-12, "um^2": 1e-12, "µm²": 1e-12 },
  share: { "%": 1e-2, "": 1 },
  number: { "": 1 },
};
// Those that a slider writes, ascending.
const WRITTEN = {
  length: ["nm", "um", "mm", "m"],
  pressure: ["Pa", "kPa", "MPa", "GPa"],
  force: ["uN", "mN", "N", "kN"],
  area: ["um^2", "mm^2"],
};

// In SI; null of what is none.
export const parsed = (value, dimension) => {
  if (typeof value === "number") return value;
  const [, number, unit] = /^\s*([-+]?[\d.]+(?:e[-+]?\d+)?)\s*(\S*)\s*$/i.exec(String(value ?? "")) || [];
  const factor = UNITS[dimension]?.[unit];
  return number === undefined || factor === undefined ? null : Number(number) * factor;
};

export const written = (value, dimension) => {
  const short = number => String(Number(number.toPrecision(3)));
  if (dimension === "share") return `${short(100 * value)} %`;
  if (!WRITTEN[dimension]) return Number(value.toPrecision(3));
  const units = WRITTEN[dimension];
  const unit = units.filter(unit => UNITS[dimension][unit] <= value * 1.0001).at(-1) || units[0];
  return `${short(value / UNITS[dimension][unit])} ${unit}`;
};

// A length for people.
export const length = metres => written(Math.abs(metres), "length").replace("um", "µm").replace(/^/, metres < 0 ? "−" : "");
