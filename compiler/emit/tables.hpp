// Objects, constant tables and records: everything that stands before the functions.
#pragma once

#include "emit/unit.hpp"
#include "ir/ir.hpp"

#include <span>
#include <string>
#include <vector>

namespace rddlc::cpp {

// A comment line that begins a part of the file, and the part; nothing if that is empty.
std::string section(const std::string& title, const std::string& text);

// "std::array<std::array<double, 3>, robot_count>" for an element type and a buffer's shape.
std::string array_type(const Unit& unit, const ir::Buffer& buffer, const std::string& element);
// "double", "float", "std::int64_t", "bool": what a table holds.
std::string table_type(ir::Scalar scalar, RealType real = RealType::Double);

bool is_zero(const ir::Value& value);
bool are_equal(std::span<const ir::Value> values);

// `text` with the comments of neighbouring lines under each other, as clang-format has them;
// without them where there is no room. Both are given without the blanks between them.
struct CommentedLine {
    std::string text;
    std::string comment;
};
std::string with_comments(const std::vector<CommentedLine>& lines);

// Joins neighbouring parts that clang-format must not touch.
std::string with_joined_regions(std::string text);

// A definition with its initialiser, in lines of at most 100 columns. Tables that need several
// lines keep their rows, out of clang-format's reach.
std::string table(const std::string& declaration, std::span<const std::int64_t> shape,
                  std::span<const ir::Value> values, RealType real = RealType::Double);
// `declaration = {item, ...};` of any items, in as many lines as it needs.
std::string list(const std::string& declaration, const std::vector<std::string>& items);

std::string objects(const Unit& unit);
// Without those that another part of the file, around this one, has as well.
std::string tables(const Unit& unit, const Unit* around = nullptr);
// A struct of the buffers of one storage.
std::string record(const Unit& unit, const std::string& name, ir::Storage storage);
std::string records(const Unit& unit);
std::string asserts(const Unit& unit);

}  // namespace rddlc::cpp
