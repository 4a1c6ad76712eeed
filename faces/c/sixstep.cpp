// SPDX-License-Identifier: Apache-2.0
// Implements the functions of sixstep.h. Each function catches the exceptions that the standard library
// throws if memory is short.
#include "faces/c/sixstep.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <string>

#include "faces/c/describe.hpp"
#include "faces/c/saved.hpp"
#include "faces/c/session.hpp"
#include "files/text_file.hpp"
#include "text/scenario/scenario_text.hpp"

struct sixstep_session {
  c_face::Session is;
};

namespace c_face {

namespace {

/// Returns the status of `call`; SIXSTEP_NO_MEMORY if there is not enough memory.
template <class Call>
sixstep_status guarded(const Call& call) noexcept {
  try {
    return call();
  } catch (...) {
    return SIXSTEP_NO_MEMORY;
  }
}

template <class Call>
sixstep_status with(sixstep_session* session, const Call& call) noexcept {
  if (session == nullptr) return SIXSTEP_MISUSE;
  return guarded([&] {
    session->is.problems.clear();
    return call(session->is);
  });
}

/// Returns a text of the session; null if there is not enough memory.
template <class Call>
const char* text_of(sixstep_session* session, std::string& (*kept)(Session&), const Call& call) noexcept {
  if (session == nullptr || !session->is.is_open()) return "";
  try {
    std::string& text = kept(session->is);
    text = call(session->is);
    return text.c_str();
  } catch (...) {
    return nullptr;
  }
}

std::vector<std::pair<std::string, std::string>> settings_of(const char* const* settings) {
  std::vector<std::pair<std::string, std::string>> out;
  for (; settings != nullptr && *settings != nullptr; ++settings) {
    const std::string setting = *settings;
    const std::size_t at = setting.find('=');
    out.emplace_back(setting.substr(0, at), at == std::string::npos ? "" : setting.substr(at + 1));
  }
  return out;
}

/// Creates a session and opens it with `open`. If `open` refuses the input, the session contains the
/// problems.
template <class Open>
sixstep_status made(sixstep_session** session, const Open& open) noexcept {
  if (session == nullptr) return SIXSTEP_MISUSE;
  *session = nullptr;
  return guarded([&] {
    auto fresh = std::make_unique<sixstep_session>();
    const sixstep_status status = open(fresh->is);
    *session = fresh.release();
    return status;
  });
}

sixstep_status misplaced(Session& session, const char* place, const char* limit, const char* cure) {
  session.problems = {{place, "", limit, cure}};
  return SIXSTEP_MISUSE;
}

/// Opens a session with the options of this or an older version of the struct.
sixstep_status opened(Session& session, Source source, const sixstep_options* options) {
  sixstep_options is = SIXSTEP_OPTIONS;
  if (options != nullptr) {
    if (options->bytes == 0 || options->bytes > sizeof is)
      return misplaced(session, "options.bytes", "must be sizeof(sixstep_options)",
                       "initialise the struct: sixstep_options options = SIXSTEP_OPTIONS");
    std::memcpy(&is, options, options->bytes);
  }
  if (is.chip < SIXSTEP_CHIP_OF_SCENARIO || is.chip > SIXSTEP_CHIP_GATES)
    return misplaced(session, "options.chip", "is not a value of sixstep_chip",
                     "use SIXSTEP_CHIP_OF_SCENARIO");
  source.chip = is.chip;
  source.settings = settings_of(is.settings);
  if (is.data != nullptr) source.data_folder = is.data;
  if (source.name.empty() && is.folder != nullptr) source.name = std::string(is.folder) + "/text";
  if (source.name.empty()) source.name = "text";
  return session.open(std::move(source));
}

const std::vector<study::Column>& columns() { return study::all_columns(); }

bool is_signal(int index) { return index >= 0 && static_cast<std::size_t>(index) < study::column_count; }

}  // namespace

}  // namespace c_face

using namespace c_face;

uint32_t sixstep_abi(void) { return SIXSTEP_ABI; }
const char* sixstep_version(void) { return SIXSTEP_VERSION; }

size_t sixstep_problem_count(const sixstep_session* session) {
  return session == nullptr ? 0 : session->is.problems.size();
}

sixstep_status sixstep_problem_at(const sixstep_session* session, size_t number, sixstep_problem* problem) {
  if (session == nullptr || problem == nullptr || number >= session->is.problems.size())
    return SIXSTEP_MISUSE;
  const base::Problem& p = session->is.problems[number];
  *problem = {p.where.c_str(), p.value.c_str(), p.limit.c_str(), p.cure.c_str()};
  return SIXSTEP_OK;
}

sixstep_status sixstep_open_file(const char* path, const sixstep_options* options,
                                 sixstep_session** session) {
  return made(session, [&](Session& fresh) {
    if (path == nullptr) return misplaced(fresh, "path", "is null", "give the path of a scenario");
    base::Result<std::string> toml = files::read_text(path);
    if (!toml) {
      fresh.problems = toml.problems();
      for (base::Problem& p : fresh.problems) p.where = path;
      return SIXSTEP_REFUSED;
    }
    return opened(fresh, {.name = path, .toml = std::move(*toml)}, options);
  });
}

sixstep_status sixstep_open_text(const char* toml, const sixstep_options* options,
                                 sixstep_session** session) {
  return made(session, [&](Session& fresh) {
    if (toml == nullptr) return misplaced(fresh, "toml", "is null", "give the text of a scenario");
    return opened(fresh, {.toml = toml}, options);
  });
}

void sixstep_free(sixstep_session* session) { delete session; }

sixstep_status sixstep_advance(sixstep_session* session, double to_s) {
  return with(session, [&](Session& s) { return s.advance(to_s); });
}
sixstep_status sixstep_advance_to_tick(sixstep_session* session) {
  return with(session, [](Session& s) { return s.advance_to_tick(); });
}
sixstep_status sixstep_advance_to_hall_edge(sixstep_session* session, double to_s) {
  return with(session, [&](Session& s) { return s.advance_to_hall_edge(to_s); });
}
sixstep_status sixstep_advance_to_crossing(sixstep_session* session, int leg, double level_V, double to_s) {
  return with(session, [&](Session& s) { return s.advance_to_crossing(leg, level_V, to_s); });
}

double sixstep_tick_after(const sixstep_session* session, double at_s) {
  return session == nullptr ? std::numeric_limits<double>::quiet_NaN() : session->is.tick_after_s(at_s);
}
double sixstep_time(const sixstep_session* session) {
  return session == nullptr ? std::numeric_limits<double>::quiet_NaN() : session->is.time_s();
}
double sixstep_period(const sixstep_session* session) {
  const study::Scenario* s = session == nullptr ? nullptr : session->is.scenario();
  return s == nullptr ? std::numeric_limits<double>::quiet_NaN() : s->pwm.period_s;
}
double sixstep_duration(const sixstep_session* session) {
  const study::Scenario* s = session == nullptr ? nullptr : session->is.scenario();
  return s == nullptr ? std::numeric_limits<double>::quiet_NaN() : s->duration_s;
}

int sixstep_signal_count(void) { return static_cast<int>(study::column_count); }

sixstep_status sixstep_signal_at(int index, sixstep_signal* signal) {
  if (!is_signal(index) || signal == nullptr) return SIXSTEP_MISUSE;
  return guarded([&] {
    const study::Column& c = columns()[static_cast<std::size_t>(index)];
    *signal = {c.name.c_str(), c.unit.c_str(), c.frame.c_str(), c.meaning.c_str()};
    return SIXSTEP_OK;
  });
}

int sixstep_signal_index(const char* name) {
  if (name == nullptr) return -1;
  int found = -1;
  (void)guarded([&] {
    const auto& all = columns();
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const study::Column& c) { return c.name == name; });
    if (at != all.end()) found = static_cast<int>(at - all.begin());
    return SIXSTEP_OK;
  });
  return found;
}

double sixstep_value(const sixstep_session* session, int index) {
  if (session == nullptr || !session->is.is_open() || !is_signal(index) || !session->is.applies(index))
    return std::numeric_limits<double>::quiet_NaN();
  return session->is.value(index);
}

sixstep_status sixstep_values(const sixstep_session* session, double* values, size_t count) {
  if (session == nullptr || !session->is.is_open() || (values == nullptr && count > 0)) return SIXSTEP_MISUSE;
  for (std::size_t c = 0; c < std::min(count, study::column_count); ++c)
    values[c] = sixstep_value(session, static_cast<int>(c));
  return SIXSTEP_OK;
}

const char* sixstep_describe(sixstep_session* session) {
  return text_of(
      session, [](Session& s) -> std::string& { return s.described; }, described);
}

sixstep_status sixstep_change(sixstep_session* session, const char* toml, double* at_s) {
  return with(session, [&](Session& s) {
    if (toml == nullptr) return misplaced(s, "toml", "is null", "give the lines of an [[at]]");
    return s.change(toml, at_s);
  });
}

sixstep_status sixstep_copy(const sixstep_session* session, sixstep_session** copy) {
  if (session == nullptr || copy == nullptr) return SIXSTEP_MISUSE;
  *copy = nullptr;
  return guarded([&] {
    *copy = new sixstep_session{c_face::Session(session->is)};
    return SIXSTEP_OK;
  });
}

size_t sixstep_save(sixstep_session* session, void* bytes, size_t room) {
  if (session == nullptr || !session->is.is_open() || session->is.outcome()) return 0;
  std::size_t size = 0;
  (void)guarded([&] {
    const std::vector<std::uint8_t> is = saved(session->is);
    if (is.size() <= room && bytes != nullptr) std::memcpy(bytes, is.data(), is.size());
    size = is.size();
    return SIXSTEP_OK;
  });
  return size;
}

sixstep_status sixstep_load(const void* bytes, size_t count, sixstep_session** session) {
  return made(session, [&](Session& fresh) {
    if (bytes == nullptr)
      return misplaced(fresh, "bytes", "are null", "give the bytes that sixstep_save() wrote");
    return loaded({static_cast<const std::uint8_t*>(bytes), count}, fresh);
  });
}

const char* sixstep_scenario(sixstep_session* session) {
  return text_of(
      session, [](Session& s) -> std::string& { return s.written; },
      [](Session& s) { return text::scenario_text(*s.scenario()); });
}

sixstep_status sixstep_finish(sixstep_session* session) {
  return with(session, [](Session& s) { return s.finish(); });
}
const char* sixstep_outcome(const sixstep_session* session) {
  return session == nullptr || !session->is.outcome() ? nullptr : session->is.outcome()->c_str();
}
uint64_t sixstep_digest(const sixstep_session* session) {
  return session == nullptr ? 0 : session->is.digest();
}

sixstep_status sixstep_measure(sixstep_session* session, sixstep_measured* measured, double* setpoint) {
  return with(session, [&](Session& s) {
    if (measured == nullptr)
      return misplaced(s, "measured", "is null", "give a pointer to a struct that the call fills");
    return s.measure(*measured, setpoint);
  });
}
sixstep_status sixstep_command(sixstep_session* session, const sixstep_answer* answer) {
  return with(session, [&](Session& s) {
    if (answer == nullptr) return misplaced(s, "answer", "is null", "give an answer");
    return s.command(*answer);
  });
}
sixstep_status sixstep_set_gates(sixstep_session* session, uint32_t gates) {
  return with(session, [&](Session& s) { return s.set_gates(gates); });
}
sixstep_status sixstep_convert(sixstep_session* session, sixstep_counts* counts) {
  return with(session, [&](Session& s) {
    if (counts == nullptr)
      return misplaced(s, "counts", "is null", "give a pointer to a struct that the call fills");
    return s.convert(*counts);
  });
}
