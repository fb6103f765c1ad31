// rddl train drp as users run it.
#include "program.hpp"

#include <filesystem>
#include <string>

namespace rddlc::cli {
namespace {

class TrainDrp : public Program {
  protected:
    Outcome train(const std::string& options) const {
        return run("train drp domain.rddl instance.rddl --out r --quiet" + options + interpreted);
    }
};

// A tank is to hold 1, and is filled by at most 1 in each step.
TEST_F(TrainDrp, WritesAPolicyThatActsAndResumes) {
    write_file(folder_ / "domain.rddl",
               "domain d { pvariables { depth : { state-fluent, real, default = 3.0 };\n"
               "  fill : { action-fluent, real, default = 0.0 }; };\n"
               "  cpfs { depth' = depth + fill; }; reward = -(depth' - 1.0) * (depth' - 1.0);\n"
               "  action-preconditions { fill >= -1; fill <= 1; }; }\n");
    write_file(folder_ / "instance.rddl",
               "non-fluents n { domain = d; }\n"
               "instance i { domain = d; non-fluents = n; horizon = 5; discount = 1.0; }\n");
    const Outcome trained = train(" --steps 4000");
    EXPECT_EQ(trained.status, 0) << trained.err;
    const Outcome played =
        run("evaluate domain.rddl instance.rddl --policy r --json" + std::string(interpreted));
    EXPECT_EQ(played.status, 0) << played.err;
    const double mean = nlohmann::json::parse(played.out)["policies"][0]["return"]["mean"];
    EXPECT_GT(mean, -2);  // the optimum is -1, no-op has -20

    const Outcome again = train(" --steps 4000");
    EXPECT_EQ(again.status, 1);
    expect_part(again.err, "holds a run already");
    const Outcome resumed = train(" --steps 8000 --resume");
    EXPECT_EQ(resumed.status, 0) << resumed.err;
    const Outcome other = train(" --steps 8000 --resume --lr 1e-4");
    EXPECT_EQ(other.status, 1);
    expect_part(other.err, "--lr was 0.003 and is 0.0001");
    for (const char* const form : {"json", "cpp", "onnx"})
        EXPECT_EQ(run("export domain.rddl instance.rddl --policy r -o p --as " + std::string(form) +
                      interpreted)
                      .status,
                  0)
            << form;
    const Outcome unknown =
        run("export domain.rddl instance.rddl --policy r -o p --as dot" + std::string(interpreted));
    EXPECT_EQ(unknown.status, 2);
    expect_part(unknown.err, "networks of DRP are not written as dot");
    const Outcome refused = train(" --relax hard");
    EXPECT_EQ(refused.status, 2);
    expect_part(refused.err, "--relax: 'hard' is not one of soft, straight, exact");
}

}  // namespace
}  // namespace rddlc::cli
