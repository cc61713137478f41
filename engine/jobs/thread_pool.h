// The smallest pool that runs the same graphs as oneTBB does: for the thread sanitizer.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace ag {

class ThreadPool {
  public:
    explicit ThreadPool(uint32_t threads) {
        for (uint32_t i = 1; i < threads; ++i)
            workers_.emplace_back([this] { work(false); });
    }
    ~ThreadPool() {
        {
            const std::lock_guard lock(mutex_);
            closing_ = true;
        }
        wake_.notify_all();
        for (std::thread& worker : workers_)
            worker.join();
    }
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    void spawn(std::function<void()> task) {
        {
            const std::lock_guard lock(mutex_);
            tasks_.push_back(std::move(task));
            ++unfinished_;
        }
        wake_.notify_one();
    }
    // The caller works too, until everything spawned is done.
    void wait() { work(true); }

    template <class F>
    void forEach(uint32_t count, F&& piece) {
        std::atomic<uint32_t> done{0};
        for (uint32_t i = 0; i < count; ++i)
            spawn([&, i] {
                piece(i);
                ++done;
            });
        while (done < count)
            if (!runOne()) std::this_thread::yield();
    }

  private:
    bool runOne() {
        std::function<void()> task;
        {
            const std::lock_guard lock(mutex_);
            if (tasks_.empty()) return false;
            task = std::move(tasks_.front());
            tasks_.pop_front();
        }
        finish(task);
        return true;
    }
    void finish(const std::function<void()>& task) {
        task();
        const std::lock_guard lock(mutex_);
        if (--unfinished_ == 0) wake_.notify_all();
    }
    void work(bool untilDone) {
        std::unique_lock lock(mutex_);
        while (true) {
            wake_.wait(lock, [&] { return closing_ || !tasks_.empty() || (untilDone && unfinished_ == 0); });
            if (tasks_.empty()) {
                if (closing_ || untilDone) return;
                continue;
            }
            const std::function<void()> task = std::move(tasks_.front());
            tasks_.pop_front();
            lock.unlock();
            finish(task);
            lock.lock();
        }
    }

    std::vector<std::thread> workers_;
    std::deque<std::function<void()>> tasks_;
    std::mutex mutex_;
    std::condition_variable wake_;
    uint32_t unfinished_ = 0;
    bool closing_ = false;
};

}  // namespace ag
