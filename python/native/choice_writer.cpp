#include "native/choice_writer.hpp"

#include "native/buffers.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

// The only category, where it is a whole number of Python's or numpy's.
std::optional<std::int64_t> whole_of(nb::handle given) {
    if (!PyIndex_Check(given.ptr())) return std::nullopt;
    const std::int64_t whole = PyNumber_AsSsize_t(given.ptr(), PyExc_OverflowError);
    if (whole != -1 || !PyErr_Occurred()) return whole;
    PyErr_Clear();
    return std::nullopt;
}

// The loop has no branch for each entry: the compiler puts several into a vector register.
bool are_within(const float* entries, std::size_t rows, std::span<const Number> numbers) {
    bool within = true;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const float lower = numbers[k].lower, upper = numbers[k].upper;
        for (std::size_t row = 0; row < rows; ++row) {
            const float entry = entries[row * numbers.size() + k];
            within &= static_cast<bool>(static_cast<int>(entry >= lower) & (entry <= upper));
        }
    }
    return within;
}

bool are_columns(const Choices& choices, std::int64_t count) {
    const auto is_column = [&](std::int64_t column) {
        return column >= 0 && column < count;
    };
    const Changes& changes = choices.changes;
    const bool have_numbers = std::ranges::all_of(choices.numbers, is_column, &Number::column);
    if (changes.columns.empty())
        return have_numbers &&
               std::ranges::all_of(choices.categories, is_column, &Category::column);
    return have_numbers && static_cast<std::int64_t>(changes.defaults.size()) == count &&
           changes.values.size() == changes.columns.size() &&
           std::ranges::all_of(changes.columns, [&](std::int64_t column) {
               return column == -1 || is_column(column);
           });
}

}  // namespace

double Squash::value_of(double number) const {
    const double share = (number + 1) / 2;
    const bool has_lower = std::isfinite(lower), has_upper = std::isfinite(upper);
    if (has_lower && has_upper) return std::min(lower + share * (upper - lower), upper);
    if (has_lower) return lower + unit * std::sinh(5 * share) / std::sinh(2.5);
    if (has_upper) return upper - unit * std::sinh(5 * (1 - share)) / std::sinh(2.5);
    return origin + unit * std::sinh(5 * number);
}

ChoiceWriter::ChoiceWriter(EnvPool& batch, Choices choices)
    : batch_(batch),
      choices_(std::move(choices)),
      number_of_(static_cast<std::size_t>(batch.action_columns()), -1),
      rows_(static_cast<std::size_t>(batch.settings().environments)),
      categories_(rows_ * choices_.categories.size()),
      numbers_(rows_ * choices_.numbers.size()) {
    if (!are_columns(choices_, batch.action_columns()) || batch.settings().doubles)
        throw Refused("there are no such columns of action values");
    for (std::size_t k = 0; k < choices_.numbers.size(); ++k)
        number_of_[static_cast<std::size_t>(choices_.numbers[k].column)] =
            static_cast<std::int64_t>(k);
    are_values_ = choices_.categories.empty() && choices_.numbers.size() == number_of_.size() &&
                  std::ranges::none_of(choices_.numbers, [](const Number& number) {
                      return number.squash.has_value();
                  });
}

bool ChoiceWriter::are_categories() const {
    bool are = true;
    const std::size_t width = choices_.categories.size();
    for (std::size_t k = 0; k < width; ++k)
        for (std::size_t at = k; at < categories_.size(); at += width)
            are &= categories_[at] >= 0 && categories_[at] < choices_.categories[k].count;
    return are;
}

bool ChoiceWriter::read_categories(nb::handle given) {
    const Entries entries(given);
    if (const auto* const all = entries.as<std::int64_t>(categories_.size())) {
        std::copy_n(all, categories_.size(), categories_.begin());
    } else {
        const auto whole = categories_.size() == 1 ? whole_of(given) : std::nullopt;
        if (!whole) return false;
        categories_[0] = *whole;
    }
    return are_categories();
}

// The numbers of a row are the first ones of `stride` entries.
template <class T>
bool ChoiceWriter::take_numbers(const T* entries, std::size_t stride) {
    bool within = true;
    const std::size_t width = choices_.numbers.size();
    for (std::size_t k = 0; k < width; ++k) {
        const T lower = choices_.numbers[k].lower, upper = choices_.numbers[k].upper;
        for (std::size_t row = 0; row < rows_; ++row) {
            const T entry = entries[row * stride + k];
            within &= entry >= lower && entry <= upper;
            numbers_[row * width + k] = entry;
        }
    }
    return within;
}

bool ChoiceWriter::read_numbers(nb::handle given) {
    const Entries entries(given);
    const std::size_t width = choices_.numbers.size();
    if (const auto* const floats = entries.as<float>(numbers_.size()))
        return take_numbers(floats, width);
    const auto* const doubles = entries.as<double>(numbers_.size());
    return doubles && take_numbers(doubles, width);
}

template <class T>
bool ChoiceWriter::read_box_of(const T* entries) {
    const std::size_t width = choices_.categories.size();
    const std::size_t stride = width + choices_.numbers.size();
    bool are_numbers = true;
    for (std::size_t row = 0; row < rows_; ++row)
        for (std::size_t k = 0; k < width; ++k) {
            const auto count = static_cast<double>(choices_.categories[k].count);
            const double share = (entries[row * stride + k] + 1) / 2;
            are_numbers &= !std::isnan(share);
            const double place = std::isnan(share) ? 0 : share * count;
            categories_[row * width + k] =
                static_cast<std::int64_t>(std::clamp(place, 0.0, count - 1));
        }
    return are_numbers && take_numbers(entries + width, stride);
}

bool ChoiceWriter::read_box(nb::handle given) {
    const Entries entries(given);
    const std::size_t size = categories_.size() + numbers_.size();
    if (const auto* const floats = entries.as<float>(size)) return read_box_of(floats);
    const auto* const doubles = entries.as<double>(size);
    return doubles && read_box_of(doubles);
}

bool ChoiceWriter::read(nb::handle actions) {
    batch_.finish();
    if (choices_.box) return read_box(actions);
    if (choices_.numbers.empty()) return read_categories(actions);
    if (choices_.categories.empty()) return read_numbers(actions);
    if (!PyDict_Check(actions.ptr()) || PyDict_Size(actions.ptr()) != 2) return false;
    const nb::handle discrete = PyDict_GetItemString(actions.ptr(), "discrete");
    const nb::handle continuous = PyDict_GetItemString(actions.ptr(), "continuous");
    return discrete && continuous && read_categories(discrete) && read_numbers(continuous);
}

void ChoiceWriter::write_row(const std::int64_t* categories, const double* numbers,
                             float* values) const {
    for (const Category& category : choices_.categories)
        values[category.column] = static_cast<float>(*categories++ + category.least);
    for (const Number& number : choices_.numbers) {
        const double given = *numbers++;
        values[number.column] =
            static_cast<float>(number.squash ? number.squash->value_of(given) : given);
    }
}

void ChoiceWriter::change_row(const std::int64_t* categories, const double* numbers,
                              float* values) const {
    const Changes& changes = choices_.changes;
    std::ranges::copy(changes.defaults, values);
    for (std::size_t k = 0; k < choices_.categories.size(); ++k) {
        const auto change = static_cast<std::size_t>(categories[k]);
        const std::int64_t column = changes.columns[change];
        if (column < 0) continue;
        const std::int64_t number = number_of_[static_cast<std::size_t>(column)];
        if (number < 0) {
            values[column] = changes.values[change];
            continue;
        }
        const std::optional<Squash>& squash =
            choices_.numbers[static_cast<std::size_t>(number)].squash;
        values[column] =
            static_cast<float>(squash ? squash->value_of(numbers[number]) : numbers[number]);
    }
}

std::optional<bool> ChoiceWriter::step(nb::handle actions, nb::handle into) {
    const Outputs outputs = batch_.outputs_in(into);
    if (are_values_) {
        const Entries given(actions);
        const auto* const numbers = given.as<float>(numbers_.size());
        if (numbers && !are_within(numbers, rows_, choices_.numbers)) return std::nullopt;
        if (numbers)
            return batch_.step_values(outputs, numbers,
                                      nb::make_tuple(nb::borrow(actions), nb::borrow(into)));
    }
    if (!read(actions)) return std::nullopt;
    auto* values = reinterpret_cast<float*>(batch_.arrays().action_values.data());
    const auto write =
        choices_.changes.columns.empty() ? &ChoiceWriter::write_row : &ChoiceWriter::change_row;
    for (std::size_t row = 0; row < rows_; ++row)
        (this->*write)(categories_.data() + row * choices_.categories.size(),
                       numbers_.data() + row * choices_.numbers.size(),
                       values + row * number_of_.size());
    return batch_.step_values(outputs);
}

namespace {

using GivenSquash = std::optional<std::tuple<double, double, double, double>>;
using GivenNumber = std::tuple<std::int64_t, float, float, GivenSquash>;
using GivenCategory = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
using GivenChanges = std::tuple<std::vector<std::int64_t>, std::vector<float>, std::vector<float>>;

Choices choices_of(const std::vector<GivenCategory>& categories,
                   const std::vector<GivenNumber>& numbers, const GivenChanges& changes, bool box) {
    const auto& [columns, values, defaults] = changes;
    Choices choices{{}, {}, {columns, values, defaults}, box};
    for (const auto& [column, count, least] : categories)
        choices.categories.push_back({column, count, least});
    for (const auto& [column, lower, upper, given] : numbers) {
        std::optional<Squash> squash;
        if (given) {
            const auto& [least, most, origin, unit] = *given;
            squash = Squash{least, most, origin, unit};
        }
        choices.numbers.push_back({column, lower, upper, squash});
    }
    return choices;
}

}  // namespace

void add_choice_writer(nb::module_& module) {
    nb::class_<ChoiceWriter>(module, "ChoiceWriter",
                             "Steps by the choices of learners; None for those that it does not "
                             "take.")
        .def(
            "__init__",
            [](ChoiceWriter* self, EnvPool& batch, const std::vector<GivenCategory>& categories,
               const std::vector<GivenNumber>& numbers, const GivenChanges& changes, bool box) {
                new (self) ChoiceWriter(batch, choices_of(categories, numbers, changes, box));
            },
            nb::arg("batch"), nb::arg("categories"), nb::arg("numbers"), nb::arg("changes"),
            nb::arg("box"), nb::keep_alive<1, 2>(),
            "categories: (column, count, least); numbers: (column, lower, upper, (lower, upper, "
            "origin, unit) of a Squash or None); changes: columns, values, defaults")
        .def("step", &ChoiceWriter::step, nb::arg("actions").none(), nb::arg("into").none());
}

}  // namespace rddlc::python
