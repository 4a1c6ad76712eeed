#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sheet_points.py TABLE [PROGRAM]: the no-load, nominal and stall points that the sheets in data/motors print, against the model.

  points        each printed value, the model's, and the reason where they part by more than rounding explains
  currents      the printed nominal current against four currents of the model at the nominal torque
  power         what a printed nominal point leaves for the winding's heat
  fit           inductance at commutation and friction that nominal and no-load current ask for; the no-load speed is the test
  offset        Hall edges early by the angle that the no-load speed asks for; the nominal torque is the test
  alternatives  deviations with other shapes, frictions and temperatures, least and greatest of all motors
  stall         torque per ampere at stall against the torque constant

Exit code 1: a deviation has no reason, or a reason stands where there is no deviation.
"""
import math
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from sheet_model import POINTS, RPM, Model, Sheet, solved  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
UNITS = {"rpm": 0, "mA": 1, "A": 3, "mNm": 1}
REASONS = {
    "A": "the inductance that acts at commutation is below the printed one, and I_0 is the supply's current (table fit)",
    "B": "its friction was measured on another motor; with the friction of the printed I_0 it parts as its sisters do",
    "C": "less torque per ampere is printed than the torque constant: the model does not saturate (table stall)",
    "D": "the sheet contradicts itself: stall torque and torque constant give U/R",
    "E": "open: its flux linkage was identified on one motor, and the sheet does not say how it is driven",
}
COMMUTATED = {name: "A" for name in POINTS[:5]}
EXPLAINED = {
    "ipower-gm5208-12": {"no_load_speed_rpm": "E"},
    "maxon-200142": COMMUTATED | {"stall_torque_mNm": "C"},
    "maxon-251601": {"no_load_current_mA": "B"} | {name: "A" for name in POINTS[2:5]},
    "maxon-339286": COMMUTATED,
    "maxon-397172": COMMUTATED | {"stall_torque_mNm": "C"},
    "maxon-488607": {"nominal_current_A": "A", "stall_torque_mNm": "C"},
    "maxon-651607": COMMUTATED,
    "maxon-651609": COMMUTATED | {"stall_current_A": "D"},
    "maxon-651614": COMMUTATED,
}


def sheets(folder=ROOT / "data/motors"):
    """(sheets whose points are compared, {name: why another one is not})."""
    found = [Sheet(file) for file in sorted(folder.glob("*.toml"))]
    return [s for s in found if s.in_the_model() is None], {s.name: s.in_the_model() for s in found if s.in_the_model()}


def nominal(compared):
    """Those with a nominal torque, with the friction of their own sheet."""
    return [s.friction_of_the_sheet() for s in compared if s.value("nominal_torque_mNm")]


def deviations(model, sheet):
    """{point: (printed, model's, deviation, rounding)}, deviations as parts."""
    found = model.points(sheet)
    rounding = model.rounding(sheet, found)
    return {point: (sheet.value(point), found[point], found[point] / sheet.value(point) - 1, rounding[point])
            for point in sheet.points() if point in found}


def verdict(name, point, deviation, rounding, explained=None):
    """(letter or "", whether the letter is as it must be)."""
    letter = (EXPLAINED if explained is None else explained).get(name, {}).get(point, "")
    return letter, bool(letter) == (abs(deviation) > rounding)


def print_points(model, compared, left_out):
    print(f"{'':<18}{'':<16}{'sheet':>8}{'model':>9}      {'off by':>8}{'rounding':>10}  reason")
    wrong = []
    for sheet in compared:
        shown = sheet.name
        for point, (printed, here, deviation, rounding) in deviations(model, sheet).items():
            words, unit = point.rsplit("_", 1)
            letter, right = verdict(sheet.name, point, deviation, rounding)
            digits = UNITS[unit]
            print(f"{shown:<18}{words.replace('_', ' '):<16}{printed:>8g}{here:>9.{digits}f} {unit:<4} {100 * deviation:>+7.2f} %{100 * rounding:>8.2f} %"
                  f"  {letter}".rstrip())
            wrong += [] if right else [f"{sheet.name}, {words}"]
            shown = ""
    for letter, words in REASONS.items():
        print(f"{letter}: {words}")
    for why in dict.fromkeys(left_out.values()):
        names = [name for name in left_out if left_out[name] == why]
        print(f"{len(names)} not compared: {why}: {', '.join(names) if len(names) < 5 else '...'}")
    if wrong:
        sys.exit(f"sheet_points: reason missing or without a deviation: {'; '.join(wrong)}")


def friction_torque(sheet):
    """N m at the printed no-load point, by the supply's power: U I_0 less the winding's heat there, which is below 1 % of it."""
    amperes = sheet.value("no_load_current_mA") * 1e-3
    heat = sheet.value("resistance_ohm") * amperes**2
    return (sheet.value("nominal_voltage_V") * amperes - heat) / (sheet.value("no_load_speed_rpm") / RPM)


def print_currents(model, compared):
    print(f"{'':<16}{'sheet':>7}   model at M_N: {'winding':>9}{'motor':>10}{'supply':>10}{'rms':>10}   (M_N + M_f)/K_t")
    for sheet in nominal(compared):
        at, printed = model.curve(sheet)["nominal"]["curve_at_torque"], sheet.value("nominal_current_A")
        cells = [100 * (at[key] / printed - 1) for key in ("winding_current_A", "motor_current_A", "bus_current_A", "phase_rms_A")]
        asked = (sheet.value("nominal_torque_mNm") + 1e3 * friction_torque(sheet)) / sheet.value("torque_constant_mNm_A")
        print(f"{sheet.name:<16}{printed:>6g} A{'':<16}" + "".join(f"{cell:>+8.1f} %" for cell in cells) + f"{asked:>10.3f} A {100 * (asked / printed - 1):>+6.1f} %")


def power(model, sheet):
    """W: (drawn, delivered, least and greatest friction, model's heat of the winding at 25 and 100 degC) at the printed nominal point."""
    speed = sheet.value("nominal_speed_rpm") / RPM
    drawn = sheet.value("nominal_voltage_V") * sheet.value("nominal_current_A")
    delivered = sheet.value("nominal_torque_mNm") * 1e-3 * speed
    dry = friction_torque(sheet) * speed
    viscous = dry * speed * RPM / sheet.value("no_load_speed_rpm")
    heat = [model.curve(sheet, "--winding", str(t))["nominal"]["curve_at_torque"]["copper_W"] for t in (25, 100)]
    return drawn, delivered, viscous, dry, *heat


def print_power(model, compared):
    print(f"{'W':<16}{'U I_N':>7}{'M_N w_N':>9}{'friction':>14}{'left':>14}   winding at 25 degC   at 100 degC")
    for sheet in nominal(compared):
        if sheet.value("nominal_speed_rpm"):
            drawn, delivered, viscous, dry, cold, warm = power(model, sheet)
            rest = drawn - delivered
            print(f"{sheet.name:<16}{drawn:>7.2f}{delivered:>9.2f}{viscous:>8.2f} ..{dry:>5.2f}{rest - dry:>8.2f} ..{rest - viscous:>5.2f}{cold:>14.2f}{warm:>18.2f}")


def fitted(model, sheet):
    """(part of the printed inductance, dry part of the friction, current that friction is computed from over the printed I_0).

    Unknowns for which the model has the printed nominal speed and current at the nominal torque and the printed I_0. Without a nominal
    speed half of the friction is dry."""
    L, dry, over = 0.8, 0.5, 1.0
    speeds = sheet.value("nominal_speed_rpm")

    def points(L, dry, over):
        return model.points(dry_part(sheet.scaled("inductance_mH", L).scaled("no_load_current_mA", over), dry))
    for _ in range(5):
        over *= sheet.value("no_load_current_mA") / points(L, dry, over)["no_load_current_mA"]
        if speeds:
            L = solved(lambda x: points(x, dry, over)["nominal_speed_rpm"], speeds, L - 0.05, L + 0.05, 3)
            dry = solved(lambda x: points(L, x, over)["nominal_current_A"], sheet.value("nominal_current_A"), 0.01, 0.99, 3)
        else:
            L = solved(lambda x: points(x, dry, over)["nominal_current_A"], sheet.value("nominal_current_A"), L - 0.05, L + 0.05, 3)
    return L, dry, over, points(L, dry, over)


def print_fit(model, compared):
    print(f"{'':<16}{'inductance':>11}{'dry part':>10}{'friction':>10}   no-load speed: {'sheet':>6}{'model':>8}{'off by':>10}{'rounding':>10}")
    for sheet in nominal(compared):
        L, dry, over, found = fitted(model, sheet)
        printed, _, _, rounding = deviations(model, sheet)["no_load_speed_rpm"]
        here = found["no_load_speed_rpm"]
        dry_cell = f"{dry:.2f}" if sheet.value("nominal_speed_rpm") else "0.5 set"
        print(f"{sheet.name:<16}{'x':>5} {L:.3f}{dry_cell:>10}{'x':>5} {over:.3f}{printed:>23g}{here:>8.0f}{100 * (here / printed - 1):>+8.2f} %{100 * rounding:>8.2f} %")


def early(model, sheet):
    """(degrees by which the Hall edges must come early for the printed no-load speed, shaft torque at the nominal speed then, N m)."""
    speed, loss = sheet.value("no_load_speed_rpm") / RPM, sheet.value("torque_constant_mNm_A") * sheet.value("no_load_current_mA") * 1e-6
    angle = solved(lambda x: model.offset_point(sheet, speed, -x)[0], loss, 2.0, 6.0, 5)
    at = sheet.value("nominal_speed_rpm") / RPM
    return angle, model.offset_point(sheet, at, -angle)[0] - loss * at / speed


def print_offset(model, compared):
    print(f"{'':<16}{'early by':>9}   torque at the nominal speed: {'sheet':>6}{'model':>8}{'off by':>10}")
    for sheet in nominal(compared):
        if sheet.value("nominal_speed_rpm"):
            angle, torque = early(model, sheet)
            printed = sheet.value("nominal_torque_mNm")
            print(f"{sheet.name:<16}{angle:>5.1f} deg{printed:>38g}{1e3 * torque:>8.1f}{100 * (1e3 * torque / printed - 1):>+8.1f} %")


def dry_part(sheet, part):
    loss = sheet.value("torque_constant_mNm_A") * sheet.value("no_load_current_mA") * 1e-3
    return sheet.with_values(coulomb_friction_mNm=part * loss)


ALTERNATIVES = {
    "as the sheet": (lambda s: s, ()),
    "sine": (lambda s: s.with_values(drop=("flat_deg",), back_emf="sine"), ()),
    "trapezoid, 170 deg flat": (lambda s: s.with_values(flat_deg=170), ()),
    "delta without its loop": (lambda s: s.with_values(connection="delta"), ()),
    "friction all dry": (lambda s: dry_part(s, 0.999999), ()),
    "winding at 100 degC": (lambda s: s, ("--winding", "100")),
    "also magnets at 60 degC": (lambda s: s, ("--winding", "100", "--housing", "60")),
    "magnets at 60 degC": (lambda s: s, ("--housing", "60")),
    "no inductance": (lambda s: s.scaled("inductance_mH", 0.01), ()),
    "inductance x 0.8": (lambda s: s.scaled("inductance_mH", 0.8), ()),
    "also friction half dry": (lambda s: dry_part(s.scaled("inductance_mH", 0.8), 0.5), ()),
}


def print_alternatives(model, compared):
    names = ("no_load_speed_rpm", "nominal_speed_rpm", "nominal_current_A")
    print(f"{'off by, %':<26}" + "".join(f"{name.rsplit('_', 1)[0].replace('_', ' '):>20}" for name in names))
    for words, (change, options) in ALTERNATIVES.items():
        rows = [(s, model.points(change(s), *options)) for s in nominal(compared)]
        cells = [[100 * (found[name] / s.value(name) - 1) for s, found in rows if s.value(name)] for name in names]
        print(f"{words:<26}" + "".join(f"{min(c):>+12.2f} ..{max(c):>+6.2f}" for c in cells))


def print_stall(_, compared):
    print(f"{'':<16}{'M_H/I_H':>9}{'rounding':>10}{'K_t':>8}   I_H/I_N")
    for sheet in nominal(compared):
        torque, current, amperes = (sheet.value(name) for name in ("stall_torque_mNm", "stall_current_A", "nominal_current_A"))
        rounding = 100 * (sheet.half("stall_torque_mNm") / torque + sheet.half("stall_current_A") / current)
        print(f"{sheet.name:<16}{torque / current:>9.2f}{rounding:>8.1f} %{sheet.value('torque_constant_mNm_A'):>8g}{current / amperes:>10.1f}")


TABLES = {"points": print_points, "currents": print_currents, "power": print_power, "fit": print_fit, "offset": print_offset,
          "alternatives": print_alternatives, "stall": print_stall}


def main(words):
    if not words or words[0] not in TABLES:
        sys.exit(__doc__)
    program = pathlib.Path(words[1] if len(words) > 1 else ROOT / "build/release/sixstep").resolve()
    if not program.is_file():
        sys.exit(f"{program} is no program; ./run builds build/release/sixstep, or name another one")
    compared, left_out = sheets()
    with tempfile.TemporaryDirectory() as folder:
        model = Model(program, folder)
        TABLES[words[0]](model, compared, *([left_out] if words[0] == "points" else []))


if __name__ == "__main__":
    main(sys.argv[1:])
