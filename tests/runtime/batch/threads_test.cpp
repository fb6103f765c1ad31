#include <rddl/batch/threads.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace rddl {
namespace {

TEST(Shares, CoverEverythingOnce) {
    for (const std::int64_t count : {1, 2, 7, 63, 64, 65, 127, 128, 1000, 4096, 100003})
        for (int workers = 1; workers <= 9 && workers <= count; ++workers) {
            std::int64_t next = 0;
            for (int worker = 0; worker < workers; ++worker) {
                const Range share = share_of(worker, workers, count, 64);
                EXPECT_EQ(share.begin, next);
                EXPECT_LT(share.begin, share.end);
                if (count >= 64 * workers) {
                    EXPECT_EQ(share.begin % 64, 0);
                }
                next = share.end;
            }
            EXPECT_EQ(next, count);
        }
}

TEST(Team, RunsEveryWorkerInEveryJob) {
    Team team(4);
    std::vector<std::int64_t> calls(static_cast<std::size_t>(team.size()), 0);
    for (int job = 0; job < 2000; ++job)
        team.run([&](int worker) { ++calls[static_cast<std::size_t>(worker)]; });
    for (const std::int64_t count : calls) EXPECT_EQ(count, 2000);
}

TEST(Team, ReturnsWhenAllAreDone) {
    Team team(3);
    for (int job = 0; job < 100; ++job) {
        std::atomic<int> done = 0;
        team.run([&](int) {
            std::this_thread::yield();
            ++done;
        });
        EXPECT_EQ(done, team.size());
    }
}

// The waiting threads are awake in some of these jobs, asleep in others, and about to fall asleep.
TEST(Team, RunsJobsAfterPausesOfAnyLength) {
    for (const int size : {2, 5}) {
        Team team(size);
        std::vector<int> calls(static_cast<std::size_t>(team.size()), 0);
        for (int job = 0; job < 300; ++job) {
            const auto microseconds = [&](int worker) {
                return std::chrono::microseconds((job * 7 + worker * 31) % 120);
            };
            const auto begin = std::chrono::steady_clock::now();
            while (std::chrono::steady_clock::now() - begin < microseconds(0)) {
            }
            team.run([&](int worker) {
                if (job % 3 == 0) std::this_thread::sleep_for(microseconds(worker));
                ++calls[static_cast<std::size_t>(worker)];
            });
        }
        for (const int count : calls) EXPECT_EQ(count, 300);
    }
}

TEST(Waiting, ReturnsWhenTheValueChanges) {
    for (const bool may_be_awake : {false, true}) {
        Waiting waiting(may_be_awake);
        std::atomic<int> value = 0;
        std::thread other([&] {
            for (int i = 0; i < 200; ++i) {
                while (value.load() != 2 * i) std::this_thread::yield();
                ++value;
                value.notify_one();
            }
        });
        for (int i = 0; i < 200; ++i) {
            waiting.wait(value, 2 * i);
            EXPECT_EQ(value, 2 * i + 1);
            ++value;
        }
        other.join();
    }
}

TEST(Team, OfOneRunsInTheCallingThread) {
    Team team(1);
    std::thread::id id;
    team.run([&](int) { id = std::this_thread::get_id(); });
    EXPECT_EQ(id, std::this_thread::get_id());
    EXPECT_EQ(team.size(), 1);
}

// Any worker may throw, also the calling thread; all have come to their end then, and the team
// still works.
TEST(Team, ThrowsWhatAWorkerThrows) {
    for (const int size : {1, 4}) {
        Team team(size);
        for (int thrower = 0; thrower < team.size(); ++thrower) {
            std::atomic<int> others = 0;
            const auto job = [&](int worker) {
                if (worker == thrower) throw std::runtime_error("worker " + std::to_string(worker));
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
                ++others;
            };
            try {
                team.run(job);
                FAIL() << "nothing was thrown";
            } catch (const std::runtime_error& error) {
                EXPECT_EQ(error.what(), "worker " + std::to_string(thrower));
            }
            EXPECT_EQ(others, team.size() - 1);
        }
        EXPECT_THROW(team.run([](int) { throw 1; }), int);  // all of them
        std::atomic<int> done = 0;
        team.run([&](int) { ++done; });
        EXPECT_EQ(done, team.size());
    }
}

TEST(Team, MayRestWithoutEverWorking) {
    Team team(4);
}

}  // namespace
}  // namespace rddl
