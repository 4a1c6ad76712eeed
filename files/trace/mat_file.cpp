// SPDX-License-Identifier: Apache-2.0
#include "files/trace/mat_file.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "text/escape/escape.hpp"

namespace files {
namespace {

constexpr char32_t replacement = 0xFFFD;

/// MATLAB counts 16-bit units, others count characters: where these differ, beyond U+FFFF, no reader is sure
/// of the sizes, and the replacement stands.
std::vector<std::uint16_t> utf16(const std::string& text) {
  std::vector<std::uint16_t> units;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t c = text::next_character(text, at);
    units.push_back(static_cast<std::uint16_t>(c < 0x10000 ? c : replacement));
  }
  return units;
}

}  // namespace

MatFile::MatFile(const Matio& library, const std::string& path, MatVersion version)
    : matio_(library),
      file_(matio_.CreateVer(path.c_str(),
                             version == MatVersion::v5 ? "MATLAB 5.0 MAT-file, sixstep " SIXSTEP_VERSION
                                                       : "MATLAB 7.3 MAT-file, sixstep " SIXSTEP_VERSION,
                             version == MatVersion::v5 ? MAT_FT_MAT5 : MAT_FT_MAT73),
            matio_.Close),
      good_(file_ != nullptr) {}

matvar_t* MatFile::text_variable(const char* name, const std::string& words) const {
  std::vector<std::uint16_t> units = utf16(words);
  std::size_t size[] = {units.empty() ? std::size_t{0} : std::size_t{1}, units.size()};
  return matio_.VarCreate(name, MAT_C_CHAR, MAT_T_UTF16, 2, size, units.data(), 0);
}

void MatFile::put(matvar_t* variable) {
  good_ = good_ && variable && matio_.VarWrite(file_.get(), variable, MAT_COMPRESSION_NONE) == 0;
  if (variable) matio_.VarFree(variable);
}

void MatFile::numbers(const std::string& name, std::vector<double> values, std::size_t rows,
                      std::size_t columns) {
  std::size_t size[] = {rows, columns};
  put(matio_.VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, values.data(), 0));
}

void MatFile::text(const std::string& name, const std::string& words) {
  put(text_variable(name.c_str(), words));
}

void MatFile::texts(const std::string& name, const std::vector<std::pair<std::string, std::string>>& fields) {
  std::vector<const char*> names;
  names.reserve(fields.size());
  for (const auto& field : fields) names.push_back(field.first.c_str());
  std::size_t size[] = {1, 1};
  matvar_t* structure =
      matio_.VarCreateStruct(name.c_str(), 2, size, names.data(), static_cast<unsigned>(names.size()));
  good_ = good_ && structure;
  if (!structure) return;
  // What is put into the structure belongs to it, and goes with it.
  for (const auto& [key, words] : fields)
    matio_.VarSetStructFieldByName(structure, key.c_str(), 0, text_variable(nullptr, words));
  put(structure);
}

void MatFile::append(const std::string& column, std::span<const double> values) {
  std::size_t size[] = {values.size(), 1};
  // The library only reads what it is told not to own.
  void* data = const_cast<double*>(values.data());
  matvar_t* piece =
      matio_.VarCreate(column.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, data, MAT_F_DONT_COPY_DATA);
  good_ = good_ && piece && matio_.VarWriteAppend(file_.get(), piece, MAT_COMPRESSION_NONE, 1) == 0;
  if (piece) matio_.VarFree(piece);
}

bool MatFile::close() {
  const bool closed = file_ && matio_.Close(file_.release()) == 0;
  return std::exchange(good_, false) && closed;
}

Scratch::Scratch() : path_((std::filesystem::temp_directory_path() / "sixstep-XXXXXX").string()) {
  const int file = ::mkstemp(path_.data());
  made_ = file >= 0;
  if (made_) ::close(file);
}

Scratch::~Scratch() {
  std::error_code ignored;
  if (made_) std::filesystem::remove(path_, ignored);
}

}  // namespace files
