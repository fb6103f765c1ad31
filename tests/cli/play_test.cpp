// rddl play with the problem that a server sends.
#include "program.hpp"

namespace rddlc::cli {
namespace {

class Play : public Program {};

TEST_F(Play, planners_read_derivatives_of_the_problem_from_the_server) {
    write_file(folder_ / "play.sh",
               "\"$1\" serve domain.rddl instance.rddl --port 0 --rounds 1 --sessions 1 "
               "--engine interpreter > address &\n"
               "until grep -q ' at ' address; do sleep 0.1; done\n"
               "\"$1\" play \"$(sed -n 's/.* at \\([0-9.:]*\\).*/\\1/p' address | head -n 1)\" "
               "--policy plan:gradient,iterations=2,horizon=3 --engine interpreter\n"
               "status=$?\n"
               "wait\n"
               "exit $status\n");
    const std::string all =
        fmt::format("cd '{}' && XDG_CACHE_HOME='{}' timeout 60 sh play.sh '{}' >/dev/null 2>'{}'",
                    folder_.string(), cache().string(), RDDL_PROGRAM, stderr_file());
    const int status = std::system(all.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 0) << read_file(stderr_file());
}

}  // namespace
}  // namespace rddlc::cli
