// Threads that wait between jobs: fork and join without starting threads anew.
//
// Uses std::thread; link with -pthread where the C library asks for it.
#ifndef ARBOC_TEAM_HPP
#define ARBOC_TEAM_HPP

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace arboc {
inline namespace v1 {

class Team {
 public:
  /// Of `size` members, of which the caller of run() is one; at least 1.
  explicit Team(int size = 1) {
    for (int member = 1; member < size; ++member)
      threads_.emplace_back([this, member] { work(member); });
  }
  ~Team() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      call_ = nullptr;
      ++round_;
    }
    begin_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const { return 1 + static_cast<int>(threads_.size()); }

  /// Calls job(member) for each member at the same time, and returns when all have ended.  A job
  /// must not throw; one run() at a time.
  template <class Job>
  void run(const Job& job) {
    if (threads_.empty()) return job(0);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      job_ = &job;
      call_ = [](const void* of, int member) { (*static_cast<const Job*>(of))(member); };
      running_ = static_cast<int>(threads_.size());
      ++round_;
    }
    begin_.notify_all();
    job(0);
    std::unique_lock<std::mutex> lock(mutex_);
    end_.wait(lock, [this] { return running_ == 0; });
  }

 private:
  void work(int member) noexcept {
    std::unique_lock<std::mutex> lock(mutex_);
    for (unsigned seen = 0;;) {
      begin_.wait(lock, [&] { return round_ != seen; });
      seen = round_;
      if (!call_) return;
      lock.unlock();
      call_(job_, member);
      lock.lock();
      if (--running_ == 0) end_.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable begin_, end_;
  const void* job_ = nullptr;
  void (*call_)(const void*, int) = nullptr;
  unsigned round_ = 0;
  int running_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_TEAM_HPP
