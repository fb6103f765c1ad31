#include "render/snapshot.hpp"

#include <charconv>
#include <cmath>
#include <utility>

namespace rddl::render {

namespace {

template <class T>
void read(std::vector<double>& numbers, const std::byte* bytes) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        T value;
        std::memcpy(&value, bytes + i * sizeof(T), sizeof value);
        numbers[i] = static_cast<double>(value);
    }
}

Values read_values(const rddl_problem& problem, const rddl_fluent& fluent, const std::byte* bytes) {
    Values values{&problem, &fluent, std::vector<double>(static_cast<std::size_t>(fluent.count))};
    switch (fluent.scalar) {
        case RDDL_BOOL:
            read<std::uint8_t>(values.numbers, bytes);
            break;
        case RDDL_INT:
            read<std::int64_t>(values.numbers, bytes);
            break;
        case RDDL_REAL:
            read<double>(values.numbers, bytes);
            break;
    }
    return values;
}

const rddl_type& parameter_type(const Values& values, int parameter) {
    return *rddl_type_at(values.problem, values.fluent->parameter_types[parameter]);
}

}  // namespace

int Values::count(int parameter) const {
    return static_cast<int>(parameter_type(*this, parameter).object_count);
}

const char* Values::object(int parameter, int index) const {
    return parameter_type(*this, parameter).objects[index];
}

const rddl_type* Values::range() const {
    return fluent->range_type < 0 ? nullptr : rddl_type_at(problem, fluent->range_type);
}

World::World(const rddl_simulator& simulator) : simulator_(simulator) {
    for (std::int32_t f = 0; f < problem().fluent_count; ++f) {
        const rddl_fluent* const fluent = rddl_fluent_at(&problem(), f);
        fluent_named_.emplace(fluent->name, fluent);
    }
}

const rddl_fluent* World::find(std::string_view names) const {
    while (true) {
        const std::size_t end = names.find('|');
        const auto found = fluent_named_.find(names.substr(0, end));
        if (found != fluent_named_.end()) return found->second;
        if (end == std::string_view::npos) return nullptr;
        names.remove_prefix(end + 1);
    }
}

const Values& World::constant(const rddl_fluent& fluent) const {
    const auto [place, is_new] = constants_.try_emplace(&fluent);
    if (is_new) {
        const std::size_t size = fluent.scalar == RDDL_BOOL ? 1 : 8;
        std::vector<std::byte> bytes(static_cast<std::size_t>(fluent.count) * size);
        const auto bytes_of_fluents = reinterpret_cast<const char*>(&fluent) -
                                      reinterpret_cast<const char*>(problem().fluents);
        const auto index = static_cast<std::int32_t>(
            bytes_of_fluents / static_cast<std::ptrdiff_t>(problem().fluent_size));
        if (simulator_.get_constants(&simulator_, index, 0, fluent.count, bytes.data()) != RDDL_OK)
            throw Error(simulator_.last_error(&simulator_));
        place->second = read_values(problem(), fluent, bytes.data());
    }
    return place->second;
}

std::string World::name_of(const rddl_fluent& fluent, std::int64_t grounding) const {
    std::string objects;
    for (std::int32_t p = fluent.rank - 1; p >= 0; --p) {
        const rddl_type& type = *rddl_type_at(&problem(), fluent.parameter_types[p]);
        const char* const object = type.objects[grounding % type.object_count];
        objects = objects.empty() ? object : object + (", " + objects);
        grounding /= type.object_count;
    }
    return fluent.rank == 0 ? fluent.name : std::string(fluent.name) + "(" + objects + ")";
}

Values Snapshot::values_in(const Step& step, const rddl_fluent& fluent) const {
    const bool is_action = fluent.role == RDDL_ACTION;
    const std::byte* record = is_action ? step.action.data() : step.state.data();
    if (is_action && step.action.empty())
        record = static_cast<const std::byte*>(problem().default_action);
    return read_values(problem(), fluent, record + fluent.offset);
}

double Snapshot::number_in(const Step& step, std::string_view name, std::size_t grounding) const {
    const rddl_fluent* const fluent = world_.find(name);
    if (!fluent) throw Error("there is no fluent '" + std::string(name) + "'");
    return values_in(step, *fluent).numbers.at(grounding);
}

double Snapshot::default_of(std::string_view name, std::size_t grounding) const {
    return number_in(Step{}, name, grounding);
}

const Values& Snapshot::values(const rddl_fluent& fluent) const {
    if (fluent.role == RDDL_NON_FLUENT) return world_.constant(fluent);
    auto& place = read_[&fluent];
    if (!place) place = std::make_unique<Values>(values_in(now(), fluent));
    return *place;
}

const Values& Snapshot::operator[](std::string_view name) const {
    const rddl_fluent* const fluent = world_.find(name);
    if (!fluent) throw Error("there is no fluent '" + std::string(name) + "'");
    return values(*fluent);
}

std::string rounded_text(double value, int digits) {
    char text[40];
    const auto end =
        std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
    return {text, end};
}

std::string number_text(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
    const double size = std::abs(value);
    const bool whole = size < 1e7 && (value == std::round(value) || size >= 1000);
    return whole ? std::to_string(std::llrint(value)) : rounded_text(value, 4);
}

std::string value_text(const Values& values, std::size_t grounding) {
    const double value = values.numbers[grounding];
    if (values.fluent->scalar == RDDL_BOOL) return value != 0 ? "true" : "false";
    const rddl_type* const range = values.range();
    if (!range) return number_text(value);
    const auto index = static_cast<std::int64_t>(value);
    return index >= 0 && index < range->object_count ? range->objects[index] : number_text(value);
}

}  // namespace rddl::render
