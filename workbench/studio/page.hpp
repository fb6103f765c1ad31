// The files of page/, as they are served.
#pragma once

#include <string_view>

namespace rddlc::studio::page {

extern const std::string_view index_html, studio_css, icon_svg;
extern const std::string_view server_js, editor_js, words_js, problem_js, chart_js, episode_js,
    try_js, compare_js, train_js, main_js;
// The problem to begin with if the user names none.
extern const std::string_view first_domain_rddl, first_instance_rddl;

}  // namespace rddlc::studio::page
