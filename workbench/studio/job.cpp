#include "studio/job.hpp"

#include "support/failure.hpp"

#include <cstring>
#include <exception>
#include <new>
#include <thread>
#include <utility>

namespace rddlc::studio {

void Workers::begin() {
    const std::scoped_lock lock(mutex_);
    ++count_;
}

void Workers::end() {
    const std::scoped_lock lock(mutex_);
    --count_;
    changed_.notify_all();
}

bool Workers::wait(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, longest, [&] { return count_ == 0; });
}

std::shared_ptr<Job> Job::start(const std::shared_ptr<Workers>& workers, Work work) {
    const std::shared_ptr<Job> job(new Job(workers));
    workers->begin();
    try {
        std::thread([job, work = std::move(work)]() mutable {
            job->run(work);
            work = {};  // frees what it holds before the program may end
            job->workers_->end();
        }).detach();
    } catch (...) {  // the system gives no thread
        workers->end();
        throw;
    }
    return job;
}

void Job::run(const Work& work) {
    try {
        Json result = work(*this);
        settle(stops() ? "stopped" : "done", std::move(result), "");
    } catch (const Failure& failure) {
        const std::string hint = failure.hint.empty() ? "" : "; " + failure.hint;
        settle(stops() ? "stopped" : "failed", nullptr, failure.what() + hint);
    } catch (const Diagnosed&) {
        settle("failed", nullptr, diagnostics_elsewhere);
    } catch (const std::bad_alloc&) {
        settle("failed", nullptr, "not enough memory");
    } catch (const std::exception& error) {
        settle("failed", nullptr, error.what());
    }
}

void Job::report(Json progress) {
    const std::scoped_lock lock(mutex_);
    progress_ = std::move(progress);
}

bool Job::is_running() const {
    const std::scoped_lock lock(mutex_);
    return std::strcmp(state_, "running") == 0;
}

void Job::settle(const char* state, Json result, std::string error) {
    const std::scoped_lock lock(mutex_);
    state_ = state;
    end_ = Clock::now();
    result_ = std::move(result);
    error_ = std::move(error);
}

Json Job::status() const {
    const std::scoped_lock lock(mutex_);
    const bool runs = std::strcmp(state_, "running") == 0;
    const std::chrono::duration<double> time = (runs ? Clock::now() : end_) - begin_;
    Json status{{"state", state_}, {"seconds", time.count()}, {"progress", progress_}};
    if (!runs) status["result"] = result_;
    if (!error_.empty()) status["error"] = error_;
    return status;
}

}  // namespace rddlc::studio
