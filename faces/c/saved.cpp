// SPDX-License-Identifier: Apache-2.0
#include "faces/c/saved.hpp"

#include <nlohmann/json.hpp>

#include <cstring>
#include <string>
#include <utility>

#include "sixstep/base/hash.hpp"
#include "text/scenario/scenario_text.hpp"

namespace c_face {

namespace {

using Cbor = nlohmann::json;

constexpr char magic[] = "sixstep session";

/// The bytes of an answer as in memory. The layout is the same in every process with the same interface
/// number and byte order.
std::vector<std::uint8_t> bytes_of(const sixstep_answer& answer) {
  std::vector<std::uint8_t> out(sizeof answer);
  std::memcpy(out.data(), &answer, sizeof answer);
  return out;
}

/// The contents of saved bytes.
struct Parts {
  Source source;
  Commands commands;
  std::uint64_t conversions = 0;
  double time_s = 0.0;
};

const Cbor* member(const Cbor& in, const char* name, Cbor::value_t type) {
  const auto found = in.find(name);
  if (found == in.end()) return nullptr;
  const bool number = type == Cbor::value_t::number_float && found->is_number();
  return found->type() == type || number ? &*found : nullptr;
}

/// A command that sets gates has no bytes of an answer.
bool read_command(const Cbor& in, Commands& out) {
  if (!in.is_array() || in.size() != 3 || !in[0].is_number_integer() || !in[1].is_number_integer() ||
      !in[2].is_binary())
    return false;
  const auto at_ps = in[0].get<std::int64_t>();
  const auto& bytes = in[2].get_binary();
  sixstep_answer answer{};
  if (bytes.empty())
    out.add(at_ps, in[1].get<std::uint32_t>());
  else if (bytes.size() != sizeof answer)
    return false;
  else
    out.add(at_ps, (std::memcpy(&answer, bytes.data(), sizeof answer), answer));
  return true;
}
/// Empty if the bytes are no saved session of this version.

std::optional<Parts> parts_of(const Cbor& in) {
  if (!in.is_object()) return std::nullopt;
  const Cbor *what = member(in, "what", Cbor::value_t::string),
             *version = member(in, "version", Cbor::value_t::string),
             *chip = member(in, "chip", Cbor::value_t::number_unsigned),
             *name = member(in, "name", Cbor::value_t::string),
             *toml = member(in, "toml", Cbor::value_t::string),
             *data = member(in, "data", Cbor::value_t::string),
             *conversions = member(in, "conversions", Cbor::value_t::number_unsigned),
             *time = member(in, "time_s", Cbor::value_t::number_float),
             *commands = member(in, "commands", Cbor::value_t::array);
  if (!what || *what != magic || !version || *version != SIXSTEP_VERSION || !chip || *chip > 3 || !name ||
      !toml || !data || !conversions || !time || !commands)
    return std::nullopt;
  Parts out{.source = {.name = name->get<std::string>(),
                       .toml = toml->get<std::string>(),
                       .data_folder = data->get<std::string>(),
                       .settings = {},
                       .chip = static_cast<sixstep_chip>(chip->get<int>())},
            .commands = {},
            .conversions = conversions->get<std::uint64_t>(),
            .time_s = time->get<double>()};
  for (const Cbor& command : *commands)
    if (!read_command(command, out.commands)) return std::nullopt;
  return out;
}

/// Number of bytes of the checksum, which follows the bytes that it covers.
constexpr std::size_t checksum_bytes = 8;

std::uint64_t checksum_of(std::span<const std::uint8_t> bytes) {
  base::Hash hash;
  for (const std::uint8_t byte : bytes) hash.word(byte);
  return hash.value();
}

/// Returns the bytes before the checksum; empty if the checksum differs.
std::span<const std::uint8_t> intact(std::span<const std::uint8_t> bytes) {
  if (bytes.size() <= checksum_bytes) return {};
  const auto body = bytes.first(bytes.size() - checksum_bytes);
  const std::uint64_t is = checksum_of(body);
  for (std::size_t k = 0; k < checksum_bytes; ++k)
    if (bytes[body.size() + k] != static_cast<std::uint8_t>(is >> (8 * k))) return {};
  return body;
}

}  // namespace

std::vector<std::uint8_t> saved(const Session& session) {
  Cbor commands = Cbor::array();
  const Commands& given = session.commands();
  for (const Command& c : given.in_order)
    commands.push_back(
        {c.at_ps, c.gates,
         Cbor::binary(c.answer == 0 ? std::vector<std::uint8_t>() : bytes_of(given.answers[c.answer - 1]))});
  const Cbor out = {{"what", magic},
                    {"version", SIXSTEP_VERSION},
                    {"chip", static_cast<unsigned>(session.source().chip)},
                    {"name", session.source().name},
                    {"toml", text::scenario_text(*session.scenario())},
                    {"data", session.source().data_folder},
                    {"conversions", session.conversions()},
                    {"time_s", session.time_s()},
                    {"commands", commands}};
  std::vector<std::uint8_t> bytes = Cbor::to_cbor(out);
  const std::uint64_t checksum = checksum_of(bytes);
  for (std::size_t k = 0; k < checksum_bytes; ++k)
    bytes.push_back(static_cast<std::uint8_t>(checksum >> (8 * k)));
  return bytes;
}

sixstep_status loaded(std::span<const std::uint8_t> bytes, Session& session) {
  const Cbor in = Cbor::from_cbor(intact(bytes), true, false);
  std::optional<Parts> parts = parts_of(in);
  if (!parts) {
    session.problems = {{"bytes", "", "are not a complete session that this version of the library saved",
                         "load all bytes that sixstep_save() of version " SIXSTEP_VERSION " wrote"}};
    return SIXSTEP_REFUSED;
  }
  if (const sixstep_status status = session.open(std::move(parts->source)); status != SIXSTEP_OK)
    return status;
  return session.replay(parts->commands, parts->conversions, parts->time_s);
}

}  // namespace c_face
