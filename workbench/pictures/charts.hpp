// Charts of what solvers reach, as files.
#pragma once

#include "learning/learning_curves.hpp"

#include <string>
#include <vector>

namespace rddlc::workbench {

struct ChartFiles {
    std::string png, svg;           // empty: not wanted
    int width = 900, height = 600;  // pixels

    bool any() const { return !png.empty() || !svg.empty(); }
};

// Curves, each with its mean as a line and a band of a standard deviation to both sides.
struct CurveChart {
    std::string title, x_title, y_title;
    std::vector<Curve> curves;
};

// A row for each: the mean as a dot, its confidence interval as a thick line, and the least and the
// greatest value as a thin one.
struct IntervalChart {
    struct Row {
        std::string name;
        double mean, half_width, minimum, maximum;
    };
    std::string title, x_title;
    std::vector<Row> rows;
};

// Throw a Failure if a file cannot be written, or rddl was built without pictures. The first
// reports it before anything is computed.
void require_writable_chart(const ChartFiles& files);
void write_chart(const CurveChart& chart, const ChartFiles& files);
void write_chart(const IntervalChart& chart, const ChartFiles& files);

}  // namespace rddlc::workbench
