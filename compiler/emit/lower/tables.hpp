// Objects, constant tables and records: everything that stands before the functions.
#pragma once

#include "emit/cpp/tree.hpp"
#include "emit/lower/unit.hpp"
#include "ir/ir.hpp"

#include <span>
#include <string>

namespace rddlc::cpp {

// A comment line that begins a part of the file, and the part; nothing if that is empty.
std::string section(const std::string& title, const std::string& text);

// "std::array<std::array<double, 3>, robot_count>" for an element type and a buffer's shape.
std::string array_type(const Unit& unit, const ir::Buffer& buffer, const std::string& element);

bool are_equal(std::span<const ir::Value> values);

// A table with its values.
tree::Statement table(const std::string& type, const std::string& name,
                      std::span<const std::int64_t> shape, std::span<const ir::Value> values,
                      RealType real = RealType::Double);

std::string objects(const Unit& unit);
// Without those that another part of the file, around this one, has as well.
std::string tables(const Unit& unit, const Unit* around = nullptr);
// A struct of the buffers of one storage.
std::string record(const Unit& unit, const std::string& name, ir::Storage storage);
std::string records(const Unit& unit);
// The functions of a simulator for the sliding buffers in a record of the state, if it has some.
std::string sliding_buffer_functions(const Unit& unit);
std::string asserts(const Unit& unit);

}  // namespace rddlc::cpp
