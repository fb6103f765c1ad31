// Replaces drawing.cpp if rddl is built without the library that draws: the page shows values.
#include "studio/drawing.hpp"
#include "support/failure.hpp"

namespace rddlc::studio {

std::vector<std::string> visualizers_for(const rddl_simulator&) {
    return {};
}

DrawnMoments drawn_moments(const SteppedEpisode&, std::size_t) {
    return {};
}

std::string picture_of(const SteppedEpisode&, const DrawnMoments&, const std::string&,
                       PictureSize) {
    throw Failure("this rddl was built without pictures");
}

}  // namespace rddlc::studio
