// SPDX-License-Identifier: Apache-2.0
// Holds a TOML file with its text, so that every complaint can quote it and give its place. If it extends
// other files, each value keeps the place in its own file.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"
#include "text/toml/toml.hpp"

namespace text {

/// `--set path=text`: replaces or adds one value.
struct Setting {
  std::string path;
  std::string text;
};

class Document {
 public:
  /// `name` is the file's name in messages.
  static base::Result<Document> parse(std::string name, std::string text);

  /// Lays this file over others, the strongest last; values of this one win. A table under a
  /// [heading] is joined with the other's key by key, however the other is written. Lists of tables are joined,
  /// the other's first, unless this one's is empty. Anything else in brackets or braces replaces the other's.
  /// Empty braces over a table remove it, as if it had not been written.
  void lay_over(std::vector<Document> bases);

  /// Applies values of the command line. A text that is no TOML value is read as a word: `chopping=hard`.
  base::Problems set(std::span<const Setting> settings);

  const toml::table& root() const { return root_; }
  toml::table& root() { return root_; }
  const std::string& name() const { return files_[0].name; }

  /// The node at "control.current.d1" or "require[1].max"; null where there is none.
  const toml::node* find(std::string_view path) const;

  /// The value's text as written; a table or a text of more than one line is not quoted.
  std::string quote(const toml::node& node, std::string_view path) const;

  /// The value as a text, for a value of the command line with the quotes that its shell needs: unit = "1", or
  /// --set 'reference.unit="1"'.
  std::string written_as_text(const toml::node& node, std::string_view path) const;

  /// "file:line:column" of a region, or "--set path" if the value came from there.
  std::string place(const toml::source_region& region) const;
  std::string place(const toml::node& node, std::string_view path) const;

  /// The file that contains the value; this file for a value of no file.
  const std::string& file_of(const toml::node& node, std::string_view path) const;

  /// 0 for a region of this file, then the files below it, the nearest first.
  std::size_t order_of(const toml::source_region& region) const;

  /// place() of the node, or of its nearest table that is in the file.
  std::string nearest_place(std::string_view path) const;

 private:
  struct File {
    std::string name, text;
    std::vector<std::size_t> lines;  ///< where each begins
  };
  Document(std::string name, std::string text, toml::table root);
  const Setting* setting_of(std::string_view path) const;
  /// The last setting of a table whose keys all come from --set, or of a value that does.
  const Setting* only_setting_in(const toml::node& node, const std::string& path) const;
  std::string_view slice(const toml::source_region& region) const;

  std::vector<File> files_;  ///< this one first
  toml::table root_;
  std::vector<Setting> settings_;
};

/// The words of a path: "require[1].max" is require, 1, max.
std::vector<std::string> path_words(std::string_view path);

}  // namespace text
