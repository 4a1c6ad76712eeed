#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Do the tests notice when the engine is wrong? Each entry of the table breaks one line in the way a tired engineer
would; a law or an analytic test must fail. By hand, not in CI; minutes:

    tools/mutants.py              all of them; exits non-zero where one survives
    tools/mutants.py 7 12         these only
    tools/mutants.py --list       the table, with the lines it stands on

All mutants are built at once into a copy under build/mutants, each behind a switch that the environment turns, so the
tree stays as it is. Left out are the digests and the reference cases: a golden value notices everything and explains
nothing. The tool fails where a text of the table is no longer found exactly once: then the entry has to follow the code.
"""
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

root = Path(__file__).resolve().parent.parent
work = root / "build" / "mutants"
programs = ("series", "sim", "plant", "rig", "study", "fuzz")
limit_s = 60  # the whole of a program takes seconds; a mutant may well run for ever

# (file under sixstep/, text with the part to be replaced in « », what replaces it). The part is an expression, or
# one statement with its semicolon; an empty replacement takes the statement away.
# Not here, because another line gives the same result: the length that useful_length() proposes (the series' own end
# decides), near_root() (a guess), the order in which settle() tries motions and sources (one alone is consistent), act()
# looking at the comparators after every segment (a guard below zero is an event at once).
table = [
    ("plant/growing.hpp", "motion == Motion::backward ? «-c.coulomb»", "c.coulomb"),
    ("plant/growing.hpp", "y.phi0[n + 1] = «-f * rotor.pole_pairs * w1»", "-f * w1"),
    ("plant/growing.hpp", "law.connected == 3 ? «high(0) - high(2)» :", "high(0) - high(1)"),
    ("plant/growing.hpp", "dc_i_2 = law.connected == 3 ? «high(1) - high(2)»", "high(1)"),
    ("plant/recurrences.hpp", "from_square(«pair.from_w1 * c.inv_pole_pairs»)", "pair.from_w1"),
    ("plant/recurrences.hpp", "m_iw = «a * b + b * e»", "a * b + b * a"),
    ("plant/recurrences.hpp", "Real(«1.0L / (n * (n + 1))»)", "1.0L / ((n + 1) * (n + 2))"),
    ("plant/recurrences.hpp", "const bool turns = «mode.motion != Motion::locked && mode.motion != Motion::stuck»",
     "mode.motion != Motion::locked"),
    ("plant/recurrences.hpp", "torque_1b = «f.rise[1] - f.rise[2]»", "f.rise[1] - f.rise[0]"),
    ("plant/recurrences.hpp", "-rate_1 * («f.rise[1] - mean_1»)", "f.rise[1]"),
    ("plant/recurrences.hpp", "of = {y.reach_i, y.reach_i_2, «y.reach_i + y.reach_i_2»}", "y.reach_i_2"),
    ("plant/expand.hpp", "out.later_x = «c.pole_pairs * out.h * r.y.reach_w / 2»", "Real(0)"),
    ("plant/expand.hpp", "y.i[1] + «y.later_i», y.i_2[1]", "Real(0)"),
    ("plant/expand.hpp", "for (int j = 0; j < «n - 1»; ++j) b /= 2", "n"),
    ("plant/expand.hpp", "before < 4096 && «!from_nothing»", "true"),
    ("plant/expand.hpp", "const bool flat = «piece.beta[law.leg[0]] == piece.beta[law.leg[1]]»",
     "piece.beta[law.leg[0]] == 0"),
    ("plant/legs_law.hpp", ".i = «(b.r_ohm - a.r_ohm) / 2»", "(a.r_ohm - b.r_ohm) / 2"),
    ("plant/legs_law.hpp", ".i_2 = «own(2) - own(1)»", "own(2) - own(0)"),
    ("plant/legs_law.hpp", "(«2 * R + a.r_ohm + b.r_ohm»)", "2 * R + 2 * a.r_ohm"),
    ("plant/pole.hpp", "pair = «law.connected == 2»", "true"),
    ("plant/pole.hpp", "(abs(law.w0) + abs(law.w1)) * («(abs(w) + reach_w) * reach_x + reach_w»)", "reach_w"),
    ("plant/guards.hpp", "- is.start, «y.bus[1] - is.slope»", "-is.slope"),
    ("plant/pole.hpp", "abs(law.w1) * («abs(x) * later_w + abs(w) * y.later_x + reach_w * reach_x»)", "abs(x) * later_w"),
    ("plant/guards.hpp", "Real(-1), «c.breakaway + c.load»", "c.breakaway - c.load"),
    ("plant/guards.hpp", "low[0] + «2 * Real(c.devices.V_f_V)»", "Real(c.devices.V_f_V)"),
    ("plant/guards.hpp", "stays_above(«y.x[0] - piece.from», y.x[1]", "y.x[0]"),
    ("plant/guards.hpp", "stays_above(«y.bus[0] + V_f - is.start»", "y.bus[0] + 2 * V_f - is.start"),
    ("plant/settle_plainly.hpp", "below_high = «s.bus + V_f - free»", "s.bus - free"),
    ("plant/settle_plainly.hpp", "if («open == 7 || !detail::two_legs_float(c, s, mode, open)») return false", "open == 7"),
    ("plant/settle.hpp", "judge(«free + V_f», noise)", "free"),
    ("plant/settle.hpp", "ok = ok && «series::leading(g, degree, noise).sign >= 0»",
     "series::leading(g, degree, noise).sign > 0"),
    ("plant/settle_plainly.hpp", "if («detail::abs(s.w) <= c.speed_noise») return false", "false"),
    ("plant/plant.hpp", "Real amp_noise = «constants_.amp_noise»", "1000 * constants_.amp_noise"),
    ("plant/settle.hpp", "Judgement::holds && «!q.series_only») return true", "true"),
    ("plant/plant.hpp", "q.i_low[third] = «-(q.i_low[first] + q.i_low[second])»", "Real(0)"),
    ("plant/plant.hpp", "«state_.x_low = 0;»", ""),
    ("plant/plant.hpp", "doubted_ = «s == 0»", "false"),
    ("plant/plant.hpp", "state_.i_low[k] = «-state_.i_low[j]»", "Real(0)"),
    ("plant/settle_plainly.hpp", "if («s.i[k] != 0») return false", "false"),
    ("plant/plant.hpp", "state_.x = ahead ? «piece.from» : piece.to", "Real(0)"),
    ("plant/plant.hpp", "Real(base::sector_rad) + «unit.x»", "state_.x"),
    ("plant/plant.hpp", "c.breakaway = «std::max(c.coulomb, Real(shaft.static_Nm))»", "c.coulomb"),
    ("plant/plant.hpp", "started = «floated & constants_.legs[legs_index(mode_.legs)].diodes»",
     "constants_.legs[legs_index(mode_.legs)].diodes"),
    ("plant/back_emf.hpp", "«(bound[b] + bound[b + 1]) / 2»", "bound[b]"),
    ("plant/back_emf.hpp", "distance >= «Real(180) - half»", "Real(180)"),
    ("plant/back_emf.hpp", "piece.beta_above[k] = «piece.beta[k] - (piece.beta[j] + piece.beta[m]) / 2»", "piece.beta[k]"),
    ("plant/circuit.hpp", "return «(U_s - highest - lowest) / Real(2)»", "(U_s + highest + lowest) / Real(2)"),
    ("plant/audit.hpp", "motion == Motion::backward ? «-c.coulomb»", "c.coulomb"),
    ("plant/audit.hpp", "if («c.locked && end_.w != 0»)", "false"),
    ("plant/plant_changes.hpp", "«if (locked) state_.w = state_.w_low = 0;»", ""),
    ("plant/plant_changes.hpp", "source_sinks = «sinks || !(constants_.inv_C > 0)»", "true"),
    ("plant/audit.hpp", "leg == Connection::low_diode ? «-i[k]»", "Real(0)"),
    ("plant/segment_energy.hpp", "devices += «terms.r_ohm * legs.square[k] - terms.offset_V * legs.charge[k]»",
     "terms.r_ohm * legs.square[k] + terms.offset_V * legs.charge[k]"),
    ("series/polynomial.hpp", "for (int j = «(n - 1) / 2 - n % 2»;", "(n - 1) / 2"),
    ("series/polynomial.hpp", "for (int n = «2 * degree»;", "2 * degree - 1"),
    ("series/polynomial.hpp", "low = «term - (sum - y)»", "dy - (sum - y)"),
    ("series/polynomial.hpp", "j = degree - 1; «j >= level»", "j > level"),
    ("series/first_root.hpp", "for (int j = 2; «j <= degree»; j += 2)", "j < degree"),
    ("series/first_root.hpp", "slope_rest + «static_cast<Real>(j)»", "static_cast<Real>(j - 1)"),
    ("series/first_root.hpp", "«of.slope_rest += of.tail;»  // with this", ""),
    ("series/first_root.hpp", "inside && «std::fabs(step) <= last_step && std::fabs(turn) <= small»", "std::fabs(step) <= 1e-2"),
    ("series/first_root.hpp", "newton - «turn * step»", "Real(0)"),
    ("series/first_root.hpp", "s * (3 * o.slope + «4 * (t * o.bend)»)", "Real(0)"),
    ("series/first_root.hpp", "«2 * (s * e.slope + t * o.slope)»", "2 * s * e.slope"),
    ("sim/run.hpp", "root < first || («event < 0 && root == first»)", "root == first"),
    ("sim/run.hpp", "if («stalled > stalled_limit»)", "stalled >= stalled_limit"),
    ("sim/run.hpp", "reached = «event < 0 && length == wanted»", "event < 0"),
    ("sim/run.hpp", "observer.segment(system, «first»)", "Real(1)"),
    ("sim/instant.hpp", "if («later.offset >= 1.0»)", "later.offset > 1.0"),
    ("sim/instant.hpp", ": «a.offset < b.offset»", "a.offset <= b.offset"),
    ("sim/instant.hpp", "static_cast<double>(to.ticks - from.ticks) + «(to.offset - from.offset)»", "0.0"),
    ("sim/instant.hpp", "std::floor(«seconds * ticks_per_second + 0.5»)", "seconds * ticks_per_second"),
    ("rig/rig.hpp", "if («!do_timeline() && !do_tick()» && modulator_.act(now_))", "!do_tick() && !do_timeline()"),
    ("rig/rig.hpp", "if («now_ < due_ && !moved_ && !watching()»)", "now_ < due_ && !watching()"),
    ("rig/rig.hpp", "«std::swap(reversed, pending_reversed_);»", ""),
    ("rig/rig.hpp", "«pending_.pair = answer.pair;»", ""),
    ("rig/rig.hpp", "same_sign = «firmware_.reversed() == reversed_»", "true"),
    ("rig/rig.hpp", "due = «(timeline_[n].at.ticks + period - 1) / period * period»",
     "(timeline_[n].at.ticks + period) / period * period"),
    ("rig/rig.hpp", "firmware_.open_loop() || «moving_»", "false"),
    ("rig/rig_inputs.hpp", "if (firmware_.follows_setpoint_at_once() && «!board_.delayed»)", "true"),
    ("rig/rig_inputs.hpp", "const Action& from = timeline_[«waveform_»]", "0"),
    ("rig/timeline.hpp", "(rate + «curvature / 2 * t_s») * t_s", "0.0"),
    ("rig/timeline.hpp", "(turns - «std::floor(turns)»)", "0.0"),
    ("rig/firmware.hpp", "* 60 + «s.x * Real(180) / Real(base::pi)»", "s.x"),
    ("rig/six_step_modulator.cpp", "Watch::phase ? «sink_pulse»", "source_pulse"),
    ("rig/pulse.hpp", "std::floor(«ticks / timer_ticks + 0.5»)", "ticks / timer_ticks"),
    ("rig/leg_timer.cpp", "«legs_[to] = legs_[from];»", ""),
    ("rig/leg_timer.cpp", "if («late != none_late») legs_", "false"),
    ("rig/six_step_modulator.cpp", "wakes = «command.enabled && !command_.enabled»", "command.enabled"),
    ("rig/leg_timer.cpp", "«leg.hold(t, dead_ticks_);»", ""),
    ("rig/leg_timer.cpp", "turn_ons_ += «on && !p.on»", "on"),
    ("rig/pulse.hpp", "!(«on_time < c.minimum_pulse_ticks»)", "false"),
    ("rig/pulse.hpp", "|| «period - on_time < c.minimum_pulse_ticks»", "false"),
    ("rig/three_leg_modulator.cpp", "timer_.connect(k, sides_of(leg), «k»)", "0"),
    ("rig/leg_channel.hpp", "if («side == side_») return", "false"),
    ("rig/leg_channel.hpp", "(«side_ == LegSide::high» ? low_from_", "side_ != LegSide::high"),
    ("rig/leg_channel.hpp", "side != LegSide::none && «t < from()»", "false"),
    ("rig/capture_clock.hpp", "«t.offset * static_cast<double>(numerator_) >= static_cast<double>(missing)»", "false"),
    ("plant/plant.hpp", "if («on_edge && state_.w < 0») pass_edge(false)", "false"),
    ("rig/firmware.hpp", "«!(config_.extras.on && config_.extras.slews_setpoint)»", "true"),
]

switch = """#pragma once
#include <cstdlib>
#include <type_traits>
inline const int sixstep_mutant = std::getenv("SIXSTEP_MUTANT") ? std::atoi(std::getenv("SIXSTEP_MUTANT")) : 0;
constexpr bool mutant_is(int n) { return !std::is_constant_evaluated() && sixstep_mutant == n; }
"""


def place(name, marked):
    """Where the marked part stands in the file: (begin, end, line)."""
    before, old, after = re.split("[«»]", marked)
    text = (root / "sixstep" / name).read_text()
    if text.count(before + old + after) != 1:
        sys.exit(f"sixstep/{name}: found {text.count(before + old + after)} times, not once: {before + old + after}")
    begin = text.index(before + old + after) + len(before)
    return begin, begin + len(old), text.count("\n", 0, begin) + 1


def broken(name):
    """The file's text with all its mutants behind switches. Several may share one place."""
    text = (root / "sixstep" / name).read_text()
    places = {}
    for number, (file, marked, new) in enumerate(table, 1):
        if file == name:
            places.setdefault(place(file, marked)[:2], []).append((number, new))
    for (begin, end), mutants in sorted(places.items(), reverse=True):
        part = text[begin:end]
        for number, new in mutants:
            part = (f"if (mutant_is({number})) {{ {new} }} else {{ {part} }}" if part.endswith(";") else
                    f"(mutant_is({number}) ? ({new}) : ({part}))")
        text = text[:begin] + part + text[end:]
    return text


def build():
    source = work / "source"
    files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=root, check=True, capture_output=True, text=True)
    copied = {file: (root / file).read_bytes() for file in files.stdout.split() if (root / file).is_file()}
    copied |= {f"sixstep/{name}": broken(name).encode() for name, _, _ in table} | {"switch.hpp": switch.encode()}
    for file, text in copied.items():
        copy = source / file
        if not copy.exists() or copy.read_bytes() != text:  # else nothing to compile anew
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(text)
    for folder, _, names in os.walk(source):  # what the tree no longer has must not be built
        for file in (Path(folder) / name for name in names):
            if str(file.relative_to(source)) not in copied:
                file.unlink()
    if not (source / "node_modules").exists():  # the report's chart library, which the build asks for
        (source / "node_modules").symlink_to(root / "node_modules")
    subprocess.run(["cmake", "-S", source, "-B", work / "build", "-G", "Ninja", "-DSIXSTEP_BENCHMARKS=OFF", "-DCMAKE_BUILD_TYPE=None",
                    f"-DCMAKE_CXX_FLAGS=-std=c++20 -O1 -w -include {source / 'switch.hpp'}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", work / "build", "--target", *(f"{p}_tests" for p in programs)], check=True)


def failing(number):
    """The tests that fail with this mutant on; one that crashes or does not end counts."""
    tests = []
    for program in programs:
        command = [work / "build" / "tests" / f"{program}_tests", "--gtest_color=no"]
        try:
            done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=limit_s,
                                  env={**os.environ, "SIXSTEP_MUTANT": str(number)})
            out, why = done.stdout, "" if done.returncode in (0, 1) else " (crashes)"
        except subprocess.TimeoutExpired as stopped:
            out, why = (stopped.stdout or b"").decode(errors="replace"), " (does not end)"
        tests += [f"{program}.{name}" for name in dict.fromkeys(re.findall(r"^\[  FAILED  \] ([\w/]+\.[\w/]+)", out, re.M))]
        if why:
            begun = re.findall(r"^\[ RUN      \] ([\w/.]+)", out, re.M)
            tests.append(f"{program}.{begun[-1] if begun else '?'}{why}")
            break  # the other programs will hardly end either
    return tests


def main():
    lines = [f"{n:3} {file}:{place(file, marked)[2]}  {marked}  ->  {new or '(gone)'}" for n, (file, marked, new) in enumerate(table, 1)]
    if sys.argv[1:] == ["--list"]:
        return print("\n".join(lines))
    build()
    if failing(0):
        sys.exit(f"without any mutant these fail: {' '.join(failing(0))}")
    chosen = [int(a) for a in sys.argv[1:]] or range(1, len(table) + 1)
    survivors = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for number, tests in zip(chosen, pool.map(failing, chosen)):
            survivors += not tests
            told = f"{len(tests)} fail: {', '.join(tests[:6])}" if tests else "SURVIVES"
            print(f"{lines[number - 1]}\n      {told}", flush=True)
    sys.exit(f"{survivors} survive" if survivors else 0)


main()
