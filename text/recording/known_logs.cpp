// SPDX-License-Identifier: Apache-2.0
#include "text/recording/known_logs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "text/keys/bounded.hpp"

namespace text {
namespace {

/// The drives of the simulation for which a column means the same.
enum class DrivesWith : std::uint8_t { any, field, blocks };

/// A column of a known log. In the formula @ is the motor's pole pairs, and # the number of the ESC.
struct KnownColumn {
  std::string_view heading;
  std::string_view formula;  ///< empty: not used
  DrivesWith drives = DrivesWith::any;
  std::string_view why{};  ///< why it is not used, or not for the other drives
};

struct KnownKind {
  std::string_view name;
  std::array<std::string_view, 3> marks;  ///< headings that the log has
  std::string_view escs;                  ///< heading of the ESC's number
  std::span<const KnownColumn> columns;
  std::size_t without_head = 0;  ///< number of columns of a log without headings
};

constexpr std::string_view mean_of_pulses =
    "a mean over PWM periods; the simulation has the current of each pulse";
constexpr std::string_view of_axes =
    "a value of the rotor's d or q axis; the simulated drive is a six-step drive";
constexpr std::string_view of_blocks =
    "the current of a six-step drive; the simulated drive is field-oriented, so i_q is compared";
constexpr std::string_view of_modulation =
    "the duty relative to the largest modulation; the simulated drive is field-oriented";

constexpr KnownColumn vesc_columns[] = {
    {"ms_today", "time=ms_today/1000"},
    {"erpm", "speed=erpm*2*pi/60/@"},
    {"input_voltage", "bus_V=input_voltage"},
    {"current_motor", "i_m=current_motor", DrivesWith::blocks, of_blocks},
    {"duty_cycle", "duty=duty_cycle", DrivesWith::blocks, of_modulation},
    {"d_axis_current", "i_d=d_axis_current", DrivesWith::field, of_axes},
    {"q_axis_current", "i_q=q_axis_current", DrivesWith::field, of_axes},
    {"d_axis_voltage", "v_d=d_axis_voltage", DrivesWith::field, of_axes},
    {"q_axis_voltage", "v_q=q_axis_voltage", DrivesWith::field, of_axes},
    {"current_in", "", DrivesWith::any, mean_of_pulses},
};
constexpr KnownColumn ardupilot_columns[] = {
    {"TimeUS", "time=TimeUS/1e6"},
    {"RPM", "speed=RPM*pi/30"},
    {"Volt", "bus_V=Volt"},
    {"Curr", "", DrivesWith::any, mean_of_pulses},
    {"Cur", "", DrivesWith::any, mean_of_pulses},
};
constexpr KnownColumn blackbox_columns[] = {
    {"time", "time=time"},
    {"eRPM[#]", "speed=eRPM[#]*100*2*pi/60/@"},
    {"vbatLatest", "bus_V=vbatLatest"},
    {"amperageLatest", "", DrivesWith::any, "the current of all motors together"},
};
constexpr KnownColumn odrive_columns[] = {
    {"vel_estimate", "speed=vel_estimate*2*pi"},
    {"vbus_voltage", "bus_V=vbus_voltage"},
    {"Id_measured", "i_d=Id_measured", DrivesWith::field, of_axes},
    {"Iq_measured", "i_q=Iq_measured", DrivesWith::field, of_axes},
    {"ibus", "", DrivesWith::any, mean_of_pulses},
};
constexpr std::string_view output_position =
    "a position from the drive's own zero, which the simulation does not have";
constexpr KnownColumn moteus_registers[] = {
    {"time", "time=time"},
    {"VELOCITY", "speed=VELOCITY*2*pi"},
    {"VOLTAGE", "bus_V=VOLTAGE"},
    {"TORQUE", "torque=TORQUE"},
    {"D_CURRENT", "i_d=D_CURRENT", DrivesWith::field, of_axes},
    {"Q_CURRENT", "i_q=Q_CURRENT", DrivesWith::field, of_axes},
    {"POSITION", "", DrivesWith::any, output_position},
};
constexpr KnownColumn moteus_stats[] = {
    {"timestamp", "time=timestamp"},
    {"velocity", "speed=velocity*2*pi"},
    {"bus_V", "bus_V=bus_V"},
    {"torque_Nm", "torque=torque_Nm"},
    {"d_A", "i_d=d_A", DrivesWith::field, of_axes},
    {"q_A", "i_q=q_A", DrivesWith::field, of_axes},
    {"position", "", DrivesWith::any, output_position},
};
// SimpleFOC's bits of monitor_variables in their order: target, voltages q and d, currents q and d in mA,
// velocity, angle. Four columns are its default: target, voltage q, velocity, angle.
constexpr std::string_view simple_foc_target = "the target, in the unit of the control mode";
constexpr KnownColumn simple_foc_all[] = {
    {"column 1", "", DrivesWith::any, simple_foc_target},
    {"column 2", "v_q=column 2", DrivesWith::field, of_axes},
    {"column 3", "v_d=column 3", DrivesWith::field, of_axes},
    {"column 4", "i_q=column 4/1000", DrivesWith::field, of_axes},
    {"column 5", "i_d=column 5/1000", DrivesWith::field, of_axes},
    {"column 6", "speed=column 6"},
    {"column 7", "", DrivesWith::any, output_position},
};
constexpr KnownColumn simple_foc_default[] = {
    {"column 1", "", DrivesWith::any, simple_foc_target},
    {"column 2", "v_q=column 2", DrivesWith::field, of_axes},
    {"column 3", "speed=column 3"},
    {"column 4", "", DrivesWith::any, output_position},
};

constexpr KnownKind known_kinds[] = {
    {"a VESC Tool log", {"ms_today", "input_voltage", "erpm"}, {}, vesc_columns},
    {"an ArduPilot ESC log", {"TimeUS", "RPM", "Volt"}, "Instance", ardupilot_columns},
    {"an ArduPilot ESC log", {"TimeUS", "RPM", "RRPM"}, "I", ardupilot_columns},
    {"a Betaflight log of blackbox_decode", {"loopIteration", "time (us)", ""}, {}, blackbox_columns},
    {"a log of moteus registers", {"time", "MODE", "VELOCITY"}, {}, moteus_registers},
    {"a log of moteus servo_stats", {"timestamp", "q_A", "velocity"}, {}, moteus_stats},
    {"a log with the names of ODrive's properties", {"vel_estimate", "Iq_measured", ""}, {}, odrive_columns},
    {"a SimpleFOC monitor log", {}, {}, simple_foc_all, 7},
    {"a SimpleFOC monitor log", {}, {}, simple_foc_default, 4},
};

bool has(const Recording& r, std::string_view heading) {
  return heading.empty() ||
         std::any_of(r.columns.begin(), r.columns.end(), [heading](const RecordedColumn& c) {
           return (c.heading == heading || c.name == heading) && c.filled;
         });
}

/// Lines of SimpleFOC's own begin with this word.
bool says_motor(std::string_view bytes) {
  return bytes.starts_with("MOT: ") || bytes.find("\nMOT: ") != bytes.npos;
}

const KnownKind* kind_of(const Recording& r, std::string_view bytes) {
  for (const KnownKind& kind : known_kinds) {
    if (kind.without_head > 0 ? !r.has_headings && r.columns.size() == kind.without_head && says_motor(bytes)
                              : std::all_of(kind.marks.begin(), kind.marks.end(),
                                            [&r](std::string_view mark) { return has(r, mark); }))
      return &kind;
  }
  return nullptr;
}

std::string replaced(std::string_view text, char letter, const std::string& by) {
  std::string out;
  for (const char c : text) out += c == letter ? by : std::string(1, c);
  return out;
}

base::Problem which_esc(const std::string& limit, const std::set<int>& known) {
  return bounded({.where = "esc",
                  .value = {},
                  .limit = limit,
                  .cure = fmt::format("choose one: {}", fmt::join(known, ", "))});
}

base::Problem one_drive_only(const Recording& r) {
  return bounded({.where = "esc",
                  .value = {},
                  .limit = fmt::format("has no effect, because {} is not a log of several ESCs", r.name),
                  .cure = "leave --esc out"});
}

/// The number of the motor whose eRPM counts.
base::Result<int> motor_of_blackbox(const Recording& r, std::optional<int> esc) {
  std::set<int> known;
  constexpr int most = 8;
  for (int n = 0; n < most; ++n)
    if (has(r, fmt::format("eRPM[{}]", n))) known.insert(n);
  if (known.empty())
    return of_recording(r, "is a Betaflight log without eRPM",
                        "turn on bidirectional DShot and the RPM field of the blackbox, and record again");
  if (esc && known.count(*esc) == 0)
    return which_esc(fmt::format("{} is no motor of {}", *esc, r.name), known);
  if (!esc && known.size() > 1)
    return which_esc(fmt::format("is missing: {} has {} motors", r.name, known.size()), known);
  return esc.value_or(*known.begin());
}

/// Takes the columns that mean the same as the simulation's.
void take_columns(const KnownKind& kind, const Recording& r, const LogColumns& wanted,
                  const std::string& motor, KnownLog& out) {
  const DrivesWith drive = wanted.field_oriented ? DrivesWith::field : DrivesWith::blocks;
  for (const KnownColumn& column : kind.columns) {
    const std::string heading = replaced(column.heading, '#', motor);
    if (kind.without_head == 0 && !has(r, heading)) continue;
    const bool by_pairs = column.formula.find('@') != std::string_view::npos;
    if (by_pairs && !wanted.pole_pairs)
      out.not_used.push_back({heading, "an electrical speed, and a linear motor has no pole pairs"});
    else if (column.formula.empty() || (column.drives != DrivesWith::any && column.drives != drive))
      out.not_used.push_back({heading, std::string(column.why)});
    else
      out.formulas.push_back(by_pairs ? replaced(replaced(column.formula, '#', motor), '@',
                                                 fmt::format("{}", *wanted.pole_pairs))
                                      : std::string(column.formula));
  }
}

}  // namespace

base::Result<std::optional<KnownLog>> known_log(const Recording& r, std::string_view bytes,
                                                const LogColumns& wanted) {
  const KnownKind* const kind = kind_of(r, bytes);
  if (kind == nullptr && wanted.esc) return one_drive_only(r);
  if (kind == nullptr) return std::optional<KnownLog>();
  KnownLog out{
      .name = std::string(kind->name), .formulas = {}, .not_used = {}, .escs = std::string(kind->escs)};
  std::string motor;
  const bool of_motors = kind->columns.data() == blackbox_columns;
  if (wanted.esc && !of_motors && kind->escs.empty()) return one_drive_only(r);
  if (of_motors) {
    const base::Result<int> chosen = motor_of_blackbox(r, wanted.esc);
    if (!chosen) return chosen.problems();
    motor = fmt::format("{}", *chosen);
  }
  if (kind->without_head > 0 && !wanted.interval_s)
    return of_recording(
        r, fmt::format("is {}, which has no time", out.name),
        "give the interval of the rows: monitor_downsample times the duration of one loop of the sketch");
  take_columns(*kind, r, wanted, motor, out);
  return std::optional(std::move(out));
}

base::Result<Recording> rows_of_esc(const Recording& r, const std::string& heading, std::optional<int> esc) {
  const auto found = std::find_if(r.columns.begin(), r.columns.end(),
                                  [&](const RecordedColumn& c) { return c.heading == heading; });
  if (found == r.columns.end()) return r;
  std::set<int> known;
  constexpr double most = 1000;
  for (const double x : found->values)
    if (x >= 0 && x <= most) known.insert(static_cast<int>(x));
  if (!esc && known.size() > 1)
    return which_esc(fmt::format("is missing: {} has rows of {} ESCs", r.name, known.size()), known);
  if (esc && known.count(*esc) == 0) return which_esc(fmt::format("{} is no ESC of {}", *esc, r.name), known);
  if (!esc) return r;
  Recording out = r;
  out.lines.clear();
  std::set<std::size_t> lines;
  for (RecordedColumn& column : out.columns) column.values.clear();
  for (std::size_t row = 0; row < r.rows(); ++row) {
    if (found->values[row] != *esc) continue;
    out.lines.emplace_back(out.rows(), r.line_of(row));
    lines.insert(r.line_of(row));
    for (std::size_t n = 0; n < r.columns.size(); ++n)
      out.columns[n].values.push_back(r.columns[n].values[row]);
  }
  // Bad cells in the rows of other ESCs do not count. Only the first bad cells of a file have their text.
  for (RecordedColumn& column : out.columns) {
    std::erase_if(column.bad, [&lines](const BadCell& cell) { return lines.count(cell.line) == 0; });
    const auto is_bad = [](double x) { return std::isnan(x); };
    column.bad_cells =
        static_cast<std::size_t>(std::count_if(column.values.begin(), column.values.end(), is_bad));
    const auto first = std::find_if(column.values.begin(), column.values.end(), is_bad);
    if (column.bad.empty() && column.bad_cells > 0)
      column.bad.push_back({out.line_of(static_cast<std::size_t>(first - column.values.begin())), ""});
  }
  return out;
}

}  // namespace text
