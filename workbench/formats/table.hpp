// Aligned text tables.
#pragma once

#include <string>
#include <vector>

namespace rddlc::workbench {

enum class Align { Left, Right };

struct Column {
    std::string title;
    Align align = Align::Left;
};

class TextTable {
  public:
    explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

    // One cell a column; missing cells are empty.
    void add_row(std::vector<std::string> cells);

    bool empty() const { return rows_.empty(); }
    // Every line begins with `indent` blanks, ends with a line break and has no trailing blanks.
    // Titles are omitted when all are empty.
    std::string text(std::size_t indent = 0) const;

  private:
    std::vector<Column> columns_;
    std::vector<std::vector<std::string>> rows_;
};

// `text` cut to `width` columns, the last of them "…" if anything was cut.
std::string shortened(std::string_view text, std::size_t width);

// Words of `text` in lines of at most `width` columns.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

// 1234567 -> "1,234,567".
std::string grouped(long long number);

}  // namespace rddlc::workbench
