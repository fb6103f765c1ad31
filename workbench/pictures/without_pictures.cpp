// Replaces the other files of this folder if rddl is built without the library that draws.
#include "pictures/charts.hpp"
#include "pictures/picture_writer.hpp"
#include "support/failure.hpp"

namespace rddlc::workbench {

struct PictureWriter::State {};

bool can_draw() {
    return false;
}

void require_pictures() {
    throw Failure("this rddl was built without pictures",
                  "install libcairo2-dev, libpng-dev, libgif-dev, pkg-config and "
                  "fonts-dejavu-core, and build it again");
}

void require_writable_chart(const ChartFiles&) {
    require_pictures();
}

void write_chart(const CurveChart&, const ChartFiles&) {
    require_pictures();
}

void write_chart(const IntervalChart&, const ChartFiles&) {
    require_pictures();
}

std::string visualizer_list() {
    require_pictures();
    return {};
}

PictureWriter::PictureWriter(const LoadedProblem&, const PictureOptions&, const std::string&) {
    require_pictures();
}

PictureWriter::~PictureWriter() = default;

void PictureWriter::add_line(std::string_view) {}

void PictureWriter::begin_second(const std::string&) {}

std::string PictureWriter::finish() {
    return {};
}

}  // namespace rddlc::workbench
