#include "pictures/rollout_pictures.hpp"

#include "formats/trace.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc::workbench {

void draw_lines(std::string_view lines, PictureWriter& pictures) {
    while (!lines.empty()) {
        const std::size_t end = std::min(lines.find('\n'), lines.size() - 1);
        pictures.add_line(lines.substr(0, end));
        lines.remove_prefix(end + 1);
    }
}

void draw_initial_states(const solvers::Rollouts& rollouts, PictureWriter& pictures) {
    for (std::size_t e = 0; e < rollouts.episodes.size(); ++e) {
        const solvers::Episode& episode = rollouts.episodes[e];
        if (episode.length == 0 && !(episode.causes & RDDL_FAULTED))
            pictures.add_line(fmt::format(R"({{"episode":{},"state":{{}},"causes":{}}})", e,
                                          causes_json(episode.causes)));
    }
}

}  // namespace rddlc::workbench
