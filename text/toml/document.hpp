// SPDX-License-Identifier: Apache-2.0
// Stores a TOML file with its text, so that every message can quote the text and state its place. If the file
// extends other files, each value keeps the place in its own file.
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

  /// Adds the values of the bases that this file does not replace. The strongest base is the last.
  /// - A value of this file replaces the same value of a base.
  /// - A table under a [heading] is joined with the base's table key by key, in whatever form the base has
  ///   it.
  /// - Lists of tables are joined, the base's tables first, unless this file's list is empty.
  /// - Anything else in brackets or braces replaces the base's value.
  /// - Empty braces remove the base's table, as if it had not been written.
  void lay_over(std::vector<Document> bases);

  /// Applies values of the command line. A text that is no TOML value becomes a word: `chopping=hard`.
  base::Problems set(std::span<const Setting> settings);

  const toml::table& root() const { return root_; }
  toml::table& root() { return root_; }
  const std::string& name() const { return files_[0].name; }

  /// The node at a path such as "control.current.d1" or "require[1].max"; null if there is none.
  const toml::node* find(std::string_view path) const;

  /// The value's text as written; empty for a table or a text of more than one line.
  std::string quote(const toml::node& node, std::string_view path) const;

  /// The value in the form of a text that the user can write: unit = "1" in a file. A value of the command
  /// line has the quotes that a shell needs: --set 'reference.unit="1"'.
  std::string written_as_text(const toml::node& node, std::string_view path) const;

  /// "file:line:column" of a region, or "--set path" for a value from the command line.
  std::string place(const toml::source_region& region) const;
  std::string place(const toml::node& node, std::string_view path) const;

  /// The file that contains the value; this file if no file contains it.
  const std::string& file_of(const toml::node& node, std::string_view path) const;

  /// The number of the file that contains a region: 0 is this file; then the files that it extends follow,
  /// the nearest first.
  std::size_t order_of(const toml::source_region& region) const;

  /// place() of the node, or of the nearest table around it that is in the file.
  std::string nearest_place(std::string_view path) const;

 private:
  struct File {
    std::string name, text;
    std::vector<std::size_t> lines;  ///< offset at which each line begins
  };
  Document(std::string name, std::string text, toml::table root);
  const Setting* setting_of(std::string_view path) const;
  /// The last setting of a value that comes from --set, or of a table whose keys all come from --set; null
  /// for other nodes.
  const Setting* only_setting_in(const toml::node& node, const std::string& path) const;
  std::string_view slice(const toml::source_region& region) const;

  std::vector<File> files_;  ///< this file, then the files that it extends
  toml::table root_;
  std::vector<Setting> settings_;
};

/// The words of a path: "require[1].max" is require, 1, max.
std::vector<std::string> path_words(std::string_view path);

}  // namespace text
