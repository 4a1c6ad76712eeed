// SPDX-License-Identifier: Apache-2.0
// Visitors of the members of described structs (base/describe.hpp). Descriptions are compiled once, for class
// Visitor. A member that is a struct, a list or an enumeration is passed to the visitor as a handle that
// hides the member's type.
#pragma once
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sixstep/base/describe.hpp"

namespace sixstep::base {

class Visitor;

using ValueMember = std::variant<double*, int*, bool*, std::string*, std::vector<double>*,
                                 std::vector<std::string>*, std::optional<double>*, std::optional<int>*,
                                 std::optional<bool>*, std::optional<std::string>*>;
using QuantityMember = std::variant<Quantity*, std::optional<Quantity>*>;
/// The quantity of the member; null if the member is optional and empty.
Quantity* quantity_in(const QuantityMember& member);

/// A member whose value is one word of a list.
class WordMember {
 public:
  struct Word {
    std::string_view word, meaning, turning;  ///< as in Choice
  };
  virtual std::size_t size() const = 0;
  virtual Word at(std::size_t n) const = 0;
  /// Index of the member's word; size() if its value has no word.
  virtual std::size_t chosen() const = 0;
  virtual void choose(std::size_t n) = 0;
  /// The member's word; empty if its value has no word.
  std::string_view word() const;
  /// The member's word in a linear motor's file, where some words replace words of the rotary motor.
  std::string_view linear_word() const;

 protected:
  ~WordMember() = default;
};

/// A member that is a described struct, or an optional described struct.
class TableMember {
 public:
  virtual bool is_optional() const = 0;
  virtual bool is_there() const = 0;
  virtual void emplace() = 0;
  /// Visits the struct, which must be present.
  virtual void walk(Visitor& visitor) = 0;
  /// Visits a default-constructed struct, for the default values.
  virtual void walk_usual(Visitor& visitor) const = 0;

 protected:
  ~TableMember() = default;
};

/// A member that is a list of described structs.
class ListMember {
 public:
  virtual std::size_t size() const = 0;
  virtual void resize(std::size_t size) = 0;
  virtual void walk(std::size_t n, Visitor& visitor) = 0;
  virtual void walk_usual(Visitor& visitor) const = 0;

 protected:
  ~ListMember() = default;
};

/// Base of all visitors. Override the functions for the kinds of members that you need; the others do
/// nothing.
class Visitor {
 public:
  template <class T>
  void value(std::string_view key, T& member, const About& about) {
    visit_value(key, &member, about);
  }
  template <class Enum, class Choices>
  void choice(std::string_view key, Enum& member, const Choices& choices, const About& about);
  template <class T>
  void quantity(std::string_view key, T& member, const About& about) {
    visit_quantity(key, &member, about);
  }
  template <class Struct>
  void table(std::string_view key, Struct& member, const About& about);
  template <class Struct>
  void list(std::string_view key, std::vector<Struct>& member, const About& about);

 protected:
  ~Visitor() = default;
  virtual void visit_value(std::string_view, const ValueMember&, const About&) {}
  virtual void visit_word(std::string_view, WordMember&, const About&) {}
  virtual void visit_quantity(std::string_view, const QuantityMember&, const About&) {}
  virtual void visit_table(std::string_view, TableMember&, const About&) {}
  virtual void visit_list(std::string_view, ListMember&, const About&) {}
};

namespace detail {

template <class Enum, class Choices>
class WordOf final : public WordMember {
 public:
  WordOf(Enum& member, const Choices& choices) : member_(member), choices_(choices) {}
  std::size_t size() const override { return std::size(choices_); }
  Word at(std::size_t n) const override {
    const auto& choice = std::data(choices_)[n];
    return {choice.word, choice.meaning, choice.turning};
  }
  std::size_t chosen() const override {
    std::size_t n = 0;
    while (n < size() && std::data(choices_)[n].value != member_) ++n;
    return n;
  }
  void choose(std::size_t n) override { member_ = std::data(choices_)[n].value; }

 private:
  Enum& member_;
  const Choices& choices_;
};

template <class Struct>
class TableOf final : public TableMember {
 public:
  explicit TableOf(Struct& member) : member_(member) {}
  bool is_optional() const override { return false; }
  bool is_there() const override { return true; }
  void emplace() override {}
  void walk(Visitor& visitor) override { describe(visitor, member_); }
  void walk_usual(Visitor& visitor) const override {
    Struct usual;
    describe(visitor, usual);
  }

 private:
  Struct& member_;
};

template <class Struct>
class TableOf<std::optional<Struct>> final : public TableMember {
 public:
  explicit TableOf(std::optional<Struct>& member) : member_(member) {}
  bool is_optional() const override { return true; }
  bool is_there() const override { return member_.has_value(); }
  void emplace() override { member_.emplace(); }
  void walk(Visitor& visitor) override { describe(visitor, *member_); }
  void walk_usual(Visitor& visitor) const override {
    Struct usual;
    describe(visitor, usual);
  }

 private:
  std::optional<Struct>& member_;
};

template <class Struct>
class ListOf final : public ListMember {
 public:
  explicit ListOf(std::vector<Struct>& member) : member_(member) {}
  std::size_t size() const override { return member_.size(); }
  void resize(std::size_t size) override { member_.resize(size); }
  void walk(std::size_t n, Visitor& visitor) override { describe(visitor, member_[n]); }
  void walk_usual(Visitor& visitor) const override {
    Struct usual;
    describe(visitor, usual);
  }

 private:
  std::vector<Struct>& member_;
};

}  // namespace detail

template <class Enum, class Choices>
void Visitor::choice(std::string_view key, Enum& member, const Choices& choices, const About& about) {
  detail::WordOf<Enum, Choices> word(member, choices);
  visit_word(key, word, about);
}

template <class Struct>
void Visitor::table(std::string_view key, Struct& member, const About& about) {
  detail::TableOf<Struct> table(member);
  visit_table(key, table, about);
}

template <class Struct>
void Visitor::list(std::string_view key, std::vector<Struct>& member, const About& about) {
  detail::ListOf<Struct> list(member);
  visit_list(key, list, about);
}

}  // namespace sixstep::base
