#include "format/assignments.hpp"

#include "format/expressions.hpp"
#include "format/items.hpp"
#include "format/plain.hpp"

#include <algorithm>
#include <span>

namespace rddlc::format {

namespace {

constexpr std::size_t gap = 2;
// Tables are read down their columns: a little more than a page is better than a broken row.
constexpr std::size_t table_width = 120;

struct Cell {
    std::string fluent;  // without arguments
    std::string name;    // "~p(a)"
    std::string value;   // empty for "p;" and "~p;"
    std::uint32_t column = 0;

    std::size_t width() const { return name.size() + (value.empty() ? 1 : value.size() + 4); }
};

struct Row {
    Lead lead;
    std::vector<Cell> cells;
    std::size_t first_column = 0;  // of the table
    // A comment behind the row, or an assignment with comments or an expression in it.
    Doc rest;

    std::size_t column_count() const { return first_column + cells.size(); }
    bool is_table_row() const { return !cells.empty(); }
};

// ------------------------------------------------------------------------------------- reading

class RowReader {
  public:
    RowReader(Cursor& cursor, std::size_t indent) : cursor_(cursor), indent_(indent) {}

    std::vector<Row> read(const std::vector<ast::Assignment>& assignments) {
        for (const ast::Assignment& assignment : assignments) {
            const auto* value = assignment.value ? &*assignment.value : nullptr;
            if (const auto* draw = value ? std::get_if<ast::ExprBox>(value) : nullptr)
                add_row_of_its_own([&] { return draw_row(**draw); });
            else if (has_comments_inside(cursor_, ";"))
                add_row_of_its_own([&] { return nest(plain(cursor_, ";")); });
            else
                add_cell();
        }
        return std::move(rows_);
    }

  private:
    template <class Read>
    void add_row_of_its_own(Read read) {
        Lead lead = cursor_.take_lead();
        rows_.push_back({std::move(lead), {}, 0, read()});
        row_is_full_ = true;
    }

    // "p(a) = Normal(0.0, 1.0);"
    Doc draw_row(const ast::Expr& draw) {
        std::vector<Doc> parts;
        parts.push_back(plain_before(cursor_, "="));
        parts.push_back(cursor_.take("="));
        parts.push_back(text(" "));
        parts.push_back(layout_expression(draw, cursor_));
        parts.push_back(cursor_.take(";"));
        return nest(concat(std::move(parts)));
    }

    void add_cell() {
        const bool begins_line = cursor_.next().begins_line();
        const std::uint32_t column = cursor_.next().column;
        if (begins_line || rows_.empty() || row_is_full_) {
            Row row{cursor_.take_lead(), {}, 0, text("")};
            if (begins_line && !row.lead.separates()) row.first_column = column_below(column);
            rows_.push_back(std::move(row));
        }
        Cell cell = read_cell(column);
        if (!fits(cell)) rows_.push_back({{}, {}, 0, text("")});
        rows_.back().cells.push_back(std::move(cell));
        rows_.back().rest = comment_;
        row_is_full_ = flat_width(comment_) == unbounded;
    }

    Cell read_cell(std::uint32_t column) {
        Cell cell{.fluent = std::string(cursor_.next().text == "~" ? cursor_.ahead(1).text
                                                                   : cursor_.next().text),
                  .name = {},
                  .value = {},
                  .column = column};
        bool is_value = false;
        while (!cursor_.is_at(";")) {
            if (!is_value && cursor_.is_at("="))
                is_value = true;
            else
                append_word(is_value ? cell.value : cell.name, cursor_.next().text);
            cursor_.take();
        }
        comment_ =
            cursor_.next().behind.empty()
                ? text("")
                : trailing_comment({cursor_.next().behind.begin(), cursor_.next().behind.end()});
        cursor_.take();
        return cell;
    }

    static void append_word(std::string& text, std::string_view word) {
        text.append(word).append(word == "," ? " " : "");
    }

    bool fits(const Cell& cell) const {
        const Row& row = rows_.back();
        std::size_t width = indent_ + cell.width();
        for (const Cell& other : row.cells) width += other.width() + gap;
        return row.cells.empty() || width <= table_width;
    }

    // The column of the table that begins in this column of the text, in the row above.
    std::size_t column_below(std::uint32_t column) const {
        if (rows_.empty()) return 0;
        const std::vector<Cell>& above = rows_.back().cells;
        const auto cell = std::find_if(above.begin(), above.end(),
                                       [&](const Cell& c) { return c.column == column; });
        return cell == above.end() ? 0 : rows_.back().first_column + (cell - above.begin());
    }

    Cursor& cursor_;
    std::size_t indent_;
    std::vector<Row> rows_;
    bool row_is_full_ = false;
    Doc comment_;
};

// ------------------------------------------------------------------------------------ printing

bool is_number(std::string_view text) {
    return !text.empty() && text.find_first_not_of("-.0123456789") == text.npos;
}
std::size_t width_before_point(std::string_view number) {
    return std::min(number.find('.'), number.size());
}

// The columns that are aligned in a table: as many as fit on the page.
enum class Alignment { ValuesAndCells, Cells, Nothing };

// A column of a table: how the cells in it are spaced.
struct Column {
    bool aligns_values = false;
    std::string fluent = {};
    bool one_fluent = true;
    bool numbers = true;
    std::size_t name = 0;          // width of names
    std::size_t before_point = 0;  // width of numbers up to the point
    std::size_t width = 0;         // of the whole

    void add(const Cell& cell) {
        if (fluent.empty()) fluent = cell.fluent;
        one_fluent = one_fluent && fluent == cell.fluent;
        numbers = numbers && is_number(cell.value);
        if (!cell.value.empty()) name = std::max(name, cell.name.size());
        before_point = std::max(before_point, width_before_point(cell.value));
    }
    std::string text(const Cell& cell) const {
        if (cell.value.empty()) return cell.name + ";";
        if (!aligns_values) return cell.name + " = " + cell.value + ";";
        std::string result = cell.name;
        result.append(std::max(name, cell.name.size()) - cell.name.size(), ' ').append(" = ");
        if (numbers && one_fluent)
            result.append(before_point - width_before_point(cell.value), ' ');
        return result.append(cell.value).append(";");
    }
};

std::vector<Column> columns_of(std::span<const Row> rows, Alignment alignment) {
    std::vector<Column> columns;
    const auto for_each_cell = [&](auto action) {
        for (const Row& row : rows)
            for (std::size_t i = 0; i < row.cells.size(); ++i)
                action(columns[row.first_column + i], row.cells[i]);
    };
    for (const Row& row : rows)
        columns.resize(std::max(columns.size(), row.column_count()),
                       {.aligns_values = alignment == Alignment::ValuesAndCells});
    for_each_cell([](Column& column, const Cell& cell) { column.add(cell); });
    for_each_cell([](Column& column, const Cell& cell) {
        column.width = std::max(column.width, column.text(cell).size());
    });
    return columns;
}

std::string in_columns(const Row& row, const std::vector<Column>& columns) {
    std::string text;
    for (std::size_t i = 0; i < row.first_column; ++i) text.append(columns[i].width + gap, ' ');
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
        const Column& column = columns[row.first_column + i];
        std::string cell = column.text(row.cells[i]);
        if (i + 1 < row.cells.size()) cell.resize(column.width + gap, ' ');
        text += cell;
    }
    return text;
}

std::string without_columns(const Row& row) {
    std::string text;
    for (const Cell& cell : row.cells)
        text.append(text.empty() ? 0 : gap, ' ').append(Column{}.text(cell));
    return text;
}

Alignment alignment_of(std::span<const Row> rows, std::size_t indent) {
    for (const Alignment alignment : {Alignment::ValuesAndCells, Alignment::Cells}) {
        const std::vector<Column> columns = columns_of(rows, alignment);
        const bool fits = std::all_of(rows.begin(), rows.end(), [&](const Row& row) {
            return indent + in_columns(row, columns).size() <= table_width;
        });
        if (fits) return alignment;
    }
    return Alignment::Nothing;
}

void print_table(std::span<const Row> rows, std::size_t indent, std::vector<TextLine>& lines) {
    const Alignment alignment = alignment_of(rows, indent);
    const std::vector<Column> columns = columns_of(rows, alignment);
    for (const Row& row : rows) {
        print_lead(row.lead, indent, lines);
        const std::string text =
            alignment == Alignment::Nothing ? without_columns(row) : in_columns(row, columns);
        render(row.rest, std::string(indent, ' ') + text, indent, lines);
    }
}

// Rows of single assignments are aligned whatever they are about, others if they are about the same
// fluents as far as both go.
bool are_alike(const Row& above, const Row& below) {
    if (!above.is_table_row() || !below.is_table_row() || below.lead.separates()) return false;
    if (below.first_column > 0) return below.first_column < above.column_count();
    if (above.column_count() == 1 && below.column_count() == 1) return true;
    if (above.first_column > 0) return above.cells.front().fluent == below.cells.front().fluent;
    const std::size_t common = std::min(above.cells.size(), below.cells.size());
    return std::equal(above.cells.begin(), above.cells.begin() + common, below.cells.begin(),
                      [](const Cell& a, const Cell& b) { return a.fluent == b.fluent; });
}

std::vector<std::span<Row>> tables_of(std::vector<Row>& rows) {
    std::vector<std::span<Row>> tables;
    for (std::size_t begin = 0; begin < rows.size();) {
        std::size_t end = begin + 1;
        while (end < rows.size() && are_alike(rows[end - 1], rows[end])) ++end;
        tables.push_back(std::span(rows).subspan(begin, end - begin));
        begin = end;
    }
    return tables;
}

// Rows of a table that is too wide for the page begin where all others do. Whether there were any.
bool drop_first_columns(std::span<Row> rows, std::size_t indent) {
    const bool has_any =
        std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.first_column > 0; });
    if (!has_any || alignment_of(rows, indent) != Alignment::Nothing) return false;
    for (Row& row : rows) row.first_column = 0;
    return true;
}

}  // namespace

void print_assignments(const std::vector<ast::Assignment>& assignments, Cursor& cursor,
                       std::size_t indent, std::vector<TextLine>& lines) {
    std::vector<Row> rows = RowReader(cursor, indent).read(assignments);
    std::vector<std::span<Row>> tables = tables_of(rows);
    while (std::any_of(tables.begin(), tables.end(),
                       [&](std::span<Row> table) { return drop_first_columns(table, indent); }))
        tables = tables_of(rows);
    for (const std::span<Row> table : tables) print_table(table, indent, lines);
}

}  // namespace rddlc::format
