// SPDX-License-Identifier: Apache-2.0
// Follows "HDF5 File Format Specification Version 3.0" of The HDF Group: superblock version 0 (II.A), groups
// by a B-tree of names (III.A1, III.B to III.D), object headers version 1 (IV.A1.a). These are the oldest
// versions, which every reader supports, and the versions that MATLAB writes.
#include "files/trace/mat73.hpp"

#include <algorithm>
#include <numeric>

namespace files {
namespace {

using Address = std::uint64_t;
constexpr Address nowhere = ~Address{0};
constexpr std::size_t user_block = 512;  // bytes before HDF5's address 0

// Types of messages in an object header, and MATLAB's code for text as characters.
enum : std::uint16_t {
  is_dataspace = 1,
  is_datatype = 3,
  is_fill = 5,
  is_layout = 8,
  is_attribute = 12,
  is_names = 17
};
constexpr std::int32_t decode_as_text = 2;

// Datatypes. Each contains class and version, bits, size, and the bit positions of the number's parts
// (IV.A2.d).
std::string float64() {
  std::string d("\x11\x20\x3f\x00", 4);
  put_bytes(d, std::uint32_t{8}, std::uint16_t{0}, std::uint16_t{64}, std::uint8_t{52}, std::uint8_t{11},
            std::uint8_t{0}, std::uint8_t{52}, std::uint32_t{1023});
  return d;
}
std::string whole(std::uint32_t bytes, bool has_sign) {
  std::string d("\x10\x00\x00\x00", 4);
  if (has_sign) d[1] = 8;
  put_bytes(d, bytes, std::uint16_t{0}, static_cast<std::uint16_t>(8 * bytes));
  return d;
}
std::string fixed_words(std::size_t bytes) {
  std::string d("\x13\x00\x00\x00", 4);
  put_bytes(d, static_cast<std::uint32_t>(bytes));
  return d;
}
std::string words_of_any_length() {
  std::string d("\x19\x00\x00\x00", 4);
  put_bytes(d, std::uint32_t{16});
  return d + fixed_words(1);
}

/// A dataspace with these sizes; without sizes, a single value.
std::string dataspace(std::initializer_list<std::uint64_t> sizes) {
  std::string d;
  put_bytes(d, std::uint8_t{1}, static_cast<std::uint8_t>(sizes.size()), std::uint16_t{0}, std::uint32_t{0});
  for (const std::uint64_t size : sizes) put_bytes(d, size);
  return d;
}

std::string message(std::uint16_t type, std::string data) {
  pad_to_eight(data);
  std::string m;
  put_bytes(m, type, static_cast<std::uint16_t>(data.size()), std::uint32_t{0});
  return m + data;
}

std::string attribute(std::string name, std::string type, std::string space, const std::string& value) {
  name += '\0';
  std::string a;
  put_bytes(a, std::uint16_t{1}, static_cast<std::uint16_t>(name.size()),
            static_cast<std::uint16_t>(type.size()), static_cast<std::uint16_t>(space.size()));
  for (std::string* part : {&name, &type, &space}) {
    pad_to_eight(*part);
    a += *part;
  }
  return message(is_attribute, a + value);
}

std::string class_attribute(const std::string& word) {
  return attribute("MATLAB_class", fixed_words(word.size()), dataspace({}), word);
}

struct Named {
  std::string name;
  Address at = 0;
};

/// Appends objects to a file. The addresses of the columns' numbers are inserted at the end, when all objects
/// are complete.
class Objects {
 public:
  /// `most_names`: largest number of names in a group. One node of the group's B-tree has space for them.
  explicit Objects(std::size_t most_names) : half_a_node_((std::max<std::size_t>(most_names, 8) + 1) / 2) {
    bytes_.resize(superblock_bytes);
  }

  Address text(const std::string& words);
  Address column(std::size_t rows);
  Address group(std::vector<Named> members, const std::string& attributes);
  Address struct_of(const MatFields& fields);

  /// Returns the complete bytes, with the root group's address in the superblock.
  std::string ended(Address root, std::size_t rows);

 private:
  static constexpr std::size_t superblock_bytes = 96;
  static constexpr std::uint16_t tree_half = 16;

  Address add(const std::string& bytes) {
    pad_to_eight(bytes_);
    const Address at = bytes_.size();
    bytes_ += bytes;
    return at;
  }
  Address object(std::size_t messages, const std::string& all);
  std::string dataset(const std::string& type, const std::string& space, Address at, std::size_t bytes);
  Address names_of(const MatFields& fields);

  std::string bytes_;
  std::size_t half_a_node_;
  std::vector<std::size_t> columns_;  ///< positions in bytes_ at which the addresses of the columns' numbers
                                      ///< are inserted
};

Address Objects::object(std::size_t messages, const std::string& all) {
  std::string head;
  put_bytes(head, std::uint8_t{1}, std::uint8_t{0}, static_cast<std::uint16_t>(messages), std::uint32_t{1},
            static_cast<std::uint32_t>(all.size()), std::uint32_t{0});
  return add(head + all);
}

/// A dataset has four messages: type, size, no fill value, and the address of its contiguous bytes.
std::string Objects::dataset(const std::string& type, const std::string& space, Address at,
                             std::size_t bytes) {
  std::string layout("\x03\x01", 2);
  put_bytes(layout, at, std::uint64_t{bytes});
  return message(is_dataspace, space) + message(is_datatype, type) +
         message(is_fill, std::string("\x02\x02\x02\x00", 4)) + message(is_layout, layout);
}

/// MATLAB's sizes are in reverse order. For an empty text, only the sizes are stored.
Address Objects::text(const std::string& words) {
  const std::vector<std::uint16_t> units = mat_units(words);
  std::string bytes, decode;
  for (const std::uint16_t unit : units) put_bytes(bytes, unit);
  put_bytes(decode, decode_as_text);
  const std::string said =
      class_attribute("char") + attribute("MATLAB_int_decode", whole(4, true), dataspace({}), decode);
  if (!units.empty())
    return object(6, dataset(whole(2, false), dataspace({units.size(), 1}), add(bytes), bytes.size()) + said);
  put_bytes(bytes, std::uint64_t{0}, std::uint64_t{0});
  return object(7, dataset(whole(8, false), dataspace({2}), add(bytes), bytes.size()) + said +
                       attribute("MATLAB_empty", whole(1, false), dataspace({}), std::string("\x01", 1)));
}

Address Objects::column(std::size_t rows) {
  if (rows == 0) {
    std::string sizes;
    put_bytes(sizes, std::uint64_t{0}, std::uint64_t{1});
    return object(6, dataset(whole(8, false), dataspace({2}), add(sizes), sizes.size()) +
                         class_attribute("double") +
                         attribute("MATLAB_empty", whole(1, false), dataspace({}), std::string("\x01", 1)));
  }
  const std::string said = class_attribute("double");
  const std::string set = dataset(float64(), dataspace({1, rows}), nowhere, rows * sizeof(double));
  const Address at = object(5, said + set);
  // The message with the layout is last: eight bytes of header, two of version and class, then the address.
  columns_.push_back(bytes_.size() - 24 + 2);
  return at;
}

/// A group consists of a heap with the names, a table of names and addresses sorted by name, and a tree with
/// one node above the table.
Address Objects::group(std::vector<Named> members, const std::string& attributes) {
  std::sort(members.begin(), members.end(), [](const Named& a, const Named& b) { return a.name < b.name; });
  std::string names(8, '\0'), table("SNOD\x01\x00", 6);
  put_bytes(table, static_cast<std::uint16_t>(members.size()));
  std::uint64_t last = 0;
  for (const Named& member : members) {
    last = names.size();
    put_bytes(table, last, member.at, std::uint32_t{0}, std::uint32_t{0}, std::uint64_t{0}, std::uint64_t{0});
    names += member.name + '\0';
    pad_to_eight(names);
  }
  table.resize(8 + 2 * half_a_node_ * 40);
  std::string heap("HEAP\x00\x00\x00\x00", 8);
  constexpr std::uint64_t no_room_left = 1;
  put_bytes(heap, std::uint64_t{names.size()}, no_room_left, add(names));
  const Address heap_at = add(heap);
  std::string tree("TREE\x00\x00", 6);
  put_bytes(tree, std::uint16_t{1}, nowhere, nowhere, std::uint64_t{0}, add(table), last);
  tree.resize(24 + (4 * tree_half + 1) * 8);
  std::string both;
  put_bytes(both, add(tree), heap_at);
  const std::size_t said = attributes.empty() ? 0 : 2;
  return object(1 + said, message(is_names, both) + attributes);
}

/// The names of the fields in their order. Each name is stored in a separate heap; the attribute contains its
/// length and its index in the heap.
Address Objects::names_of(const MatFields& fields) {
  constexpr std::size_t least = 4096;
  std::string heap("GCOL\x01\x00\x00\x00", 8);
  put_bytes(heap, std::uint64_t{0});
  std::uint16_t number = 0;
  for (const auto& field : fields) {
    put_bytes(heap, ++number, std::uint16_t{0}, std::uint32_t{0}, std::uint64_t{field.first.size()});
    heap += field.first;
    pad_to_eight(heap);
  }
  const std::size_t size = std::max(least, heap.size() + 16);
  put_bytes(heap, std::uint64_t{0}, std::uint64_t{size - heap.size()});  // object 0: the free space
  heap.resize(size);
  const std::uint64_t told = size;
  std::copy_n(reinterpret_cast<const char*>(&told), sizeof told, heap.begin() + 8);
  return add(heap);
}

Address Objects::struct_of(const MatFields& fields) {
  std::vector<Named> members;
  for (const auto& [name, words] : fields) members.push_back({name, text(words)});
  const Address names = names_of(fields);
  std::string order;
  std::uint32_t number = 0;
  for (const auto& field : fields)
    put_bytes(order, static_cast<std::uint32_t>(field.first.size()), names, ++number);
  return group(std::move(members),
               class_attribute("struct") +
                   attribute("MATLAB_fields", words_of_any_length(), dataspace({fields.size()}), order));
}

std::string Objects::ended(Address root, std::size_t rows) {
  pad_to_eight(bytes_);
  Address next = bytes_.size();
  for (const std::size_t place : columns_) {
    std::copy_n(reinterpret_cast<const char*>(&next), sizeof next,
                bytes_.begin() + static_cast<std::ptrdiff_t>(place));
    next += rows * sizeof(double);
  }
  std::string super("\x89HDF\r\n\x1a\n\x00\x00\x00\x00\x00\x08\x08\x00", 16);
  put_bytes(super, static_cast<std::uint16_t>(half_a_node_), tree_half, std::uint32_t{0});
  put_bytes(super, std::uint64_t{user_block}, nowhere, std::uint64_t{user_block + next}, nowhere);
  put_bytes(super, std::uint64_t{0}, root, std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{0});
  std::string out = mat_header("7.3", 0x0200);
  out.resize(user_block, '\0');
  return out + super + bytes_.substr(superblock_bytes);
}

}  // namespace

std::string mat73_head(const std::vector<std::pair<std::string, MatFields>>& structs,
                       std::span<const std::string> columns, std::size_t rows) {
  std::size_t most = structs.size() + columns.size();
  for (const auto& each : structs) most = std::max(most, each.second.size());
  Objects objects(most);
  std::vector<Named> all;
  all.reserve(structs.size() + columns.size());
  for (const auto& [name, fields] : structs) all.push_back({name, objects.struct_of(fields)});
  for (const std::string& name : columns) all.push_back({name, objects.column(rows)});
  return objects.ended(objects.group(std::move(all), ""), rows);
}

}  // namespace files
