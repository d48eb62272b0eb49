// SPDX-License-Identifier: GPL-3.0-or-later
#include "torture/workers.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

namespace droplet::torture {
namespace {

using Clock = std::chrono::steady_clock;

/// Verdict in the form sent between processes.
struct Record {
    Outcome outcome = Outcome::Failed;
    std::size_t droplets = 0;
    std::size_t triangles = 0;
    double seconds = 0.0;
    double min_angle = 0.0;
    std::array<char, 2000> message{};
};
static_assert(std::is_trivially_copyable_v<Record>);

Record recordOf(const Verdict& verdict)
{
    Record record{verdict.outcome, verdict.droplets, verdict.triangles, verdict.seconds, verdict.min_angle, {}};
    verdict.message.copy(record.message.data(), record.message.size() - 1);
    return record;
}

Verdict verdictOf(const Record& record)
{
    return {record.outcome, record.droplets, record.triangles, record.seconds, record.min_angle, record.message.data()};
}

void require(bool success, const char* what)
{
    if (!success) {
        throw std::system_error(errno, std::generic_category(), what);
    }
}

/// Limits the processor time of this process from now on.
void limitProcessor(double seconds)
{
    itimerval limit{};
    limit.it_value.tv_sec = static_cast<time_t>(seconds);
    limit.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
    require(setitimer(ITIMER_PROF, &limit, nullptr) == 0, "setitimer");
}

/// Main loop of a child: receives an index and sends a verdict, until the socket is shut.
[[noreturn]] void serve(int socket, const std::function<Verdict(std::size_t)>& work, const WorkOptions& options)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::size_t index = 0;
    while (read(socket, &index, sizeof index) == static_cast<ssize_t>(sizeof index)) {
        limitProcessor(options.processor_limit);
        Verdict verdict;
        try {
            verdict = work(index);
        } catch (const std::exception& error) {
            verdict.message = std::string("threw ") + error.what();
        }
        const Record record = recordOf(verdict);
        if (write(socket, &record, sizeof record) != static_cast<ssize_t>(sizeof record)) {
            break;
        }
    }
    _exit(0);
}

/// Child process and its current item.
class Worker {
public:
    Worker(const std::function<Verdict(std::size_t)>& work, const WorkOptions& options)
    {
        std::array<int, 2> ends{};
        require(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) == 0, "socketpair");
        std::fflush(nullptr);
        process_ = fork();
        require(process_ >= 0, "fork");
        if (process_ == 0) {
            close(ends[0]);
            serve(ends[1], work, options);
        }
        close(ends[1]);
        socket_ = ends[0];
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    /// Shuts the socket, which ends the process, and waits. Closing is not enough, as later children inherit the
    /// socket.
    ~Worker()
    {
        shutdown(socket_, SHUT_RDWR);
        close(socket_);
        waitpid(process_, nullptr, 0);
    }

    [[nodiscard]] int socket() const { return socket_; }
    [[nodiscard]] std::size_t item() const { return item_; }
    [[nodiscard]] bool isLate(const WorkOptions& options) const
    {
        return std::chrono::duration<double>(Clock::now() - since_).count() > options.patience;
    }

    void give(std::size_t item)
    {
        item_ = item;
        since_ = Clock::now();
        // Sending to a dead process fails; reading its verdict then shows that.
        [[maybe_unused]] const ssize_t sent = send(socket_, &item, sizeof item, MSG_NOSIGNAL);
    }

    /// Verdict; empty if the process has ended.
    [[nodiscard]] std::optional<Verdict> verdict() const
    {
        Record record;
        if (read(socket_, &record, sizeof record) != static_cast<ssize_t>(sizeof record)) {
            return std::nullopt;
        }
        return verdictOf(record);
    }

    void end() const { kill(process_, SIGKILL); }

    /// How the process ended. Precondition: it has ended.
    std::string obituary() const
    {
        siginfo_t info{};
        require(waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOWAIT) == 0, "waitid");
        if (info.si_code == CLD_EXITED) {
            return "ended the process with exit code " + std::to_string(info.si_status);
        }
        if (info.si_status == SIGPROF) {
            return "did not end within the limit of processor time";
        }
        return "ended the process: " + std::string(strsignal(info.si_status));
    }

private:
    pid_t process_ = -1;
    int socket_ = -1;
    std::size_t item_ = 0;
    Clock::time_point since_;
};

}  // namespace

void workThrough(std::size_t count, const std::function<Verdict(std::size_t index)>& work,
                 const std::function<void(std::size_t index, const Verdict& verdict)>& done, const WorkOptions& options)
{
    std::size_t next = 0;
    std::vector<std::unique_ptr<Worker>> workers;
    while (workers.size() < std::min(options.workers, count)) {
        workers.push_back(std::make_unique<Worker>(work, options));
        workers.back()->give(next++);
    }
    while (!workers.empty()) {
        std::vector<pollfd> events;
        events.reserve(workers.size());
        for (const auto& worker : workers) {
            events.push_back({worker->socket(), POLLIN, 0});
        }
        constexpr int kLook = 1000;  // [ms]
        require(poll(events.data(), events.size(), kLook) >= 0 || errno == EINTR, "poll");
        for (std::size_t k = 0; k < workers.size(); ++k) {
            Worker& worker = *workers[k];
            // A process that has answered or died is not late, even if that is noticed late.
            const bool silent = events[k].revents == 0;
            if (silent && !worker.isLate(options)) {
                continue;
            }
            if (silent) {
                worker.end();
            }
            std::optional<Verdict> verdict = worker.verdict();
            const bool fallen = !verdict;
            if (fallen) {
                verdict = Verdict{};
                verdict->message = silent ? "did not end" : worker.obituary();
            }
            done(worker.item(), *verdict);
            if (next == count) {
                workers[k].reset();
                continue;
            }
            if (silent || fallen) {
                workers[k] = std::make_unique<Worker>(work, options);
            }
            workers[k]->give(next++);
        }
        std::erase(workers, nullptr);
    }
}

}  // namespace droplet::torture
