# SPDX-License-Identifier: Apache-2.0
"""Converts printed quantities to numbers in SI: "55.8 mA" is 0.0558 A."""
import re
from math import pi

PREFIX = {"": 1.0, "f": 1e-15, "p": 1e-12, "n": 1e-9, "u": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6}
BASE = {"A": ("A", 1.0), "V": ("V", 1.0), "W": ("W", 1.0), "J": ("J", 1.0), "s": ("s", 1.0), "Hz": ("Hz", 1.0), "ohm": ("ohm", 1.0),
        "H": ("H", 1.0), "N m": ("N m", 1.0), "Nm": ("N m", 1.0), "N": ("N", 1.0), "rad/s": ("rad/s", 1.0), "m/s": ("m/s", 1.0),
        "Wb": ("V s", 1.0), "V s": ("V s", 1.0)}
PLAIN = {"": ("1", 1.0), "%": ("1", 0.01), "deg": ("deg", 1.0), "rpm": ("rad/s", pi / 30), "degC": ("degC", 1.0), "mm": ("m", 1e-3),
         "dB": ("dB", 1.0), "rad": ("rad", 1.0), "m": ("m", 1.0), "rad/s^2": ("rad/s2", 1.0)}
QUANTITY = re.compile(r"^([-+]?(?:\d+(?:\.\d+)?(?:e[-+]?\d+)?))\s*(.*)$")


def unit_of(text):
    """(dimension, factor), or None if the text is no known unit."""
    text = text.strip()
    if text in PLAIN:
        return PLAIN[text]
    if text in BASE:
        return BASE[text]
    if text[:1] in PREFIX and text[1:] in BASE:
        dimension, factor = BASE[text[1:]]
        return dimension, factor * PREFIX[text[0]]
    return None


def quantity(text):
    """(value in SI, dimension, half of the last printed digit in SI), or None."""
    m = QUANTITY.match(text.strip())
    if not m or unit_of(m.group(2)) is None:
        return None
    dimension, factor = unit_of(m.group(2))
    mantissa, _, exponent = m.group(1).partition("e")
    digits = len(mantissa.partition(".")[2])
    return float(m.group(1)) * factor, dimension, 0.5 * 10.0 ** (int(exponent or 0) - digits) * factor
