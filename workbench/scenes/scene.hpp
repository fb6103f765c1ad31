// A scene file as a visualizer.
#pragma once

#include "problems/problem_lookup.hpp"

#include <render/visualizer.hpp>

#include <filesystem>

namespace rddlc::workbench {

// Throws a Failure, or Diagnosed after it has printed what is wrong in the expressions.
rddl::render::Visualizer scene_visualizer(const ProblemFiles& files,
                                          const std::filesystem::path& scene_file);

}  // namespace rddlc::workbench
