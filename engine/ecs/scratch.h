// A list that keeps its memory from use to use. A thread that waits inside a loop may run another system
// meanwhile, so each borrower gets a list of its own.
#pragma once

#include <utility>
#include <vector>

namespace ag {

template <class T>
class Scratch {
  public:
    Scratch() {
        std::vector<std::vector<T>>& idle = lists();
        if (idle.empty()) return;
        list_ = std::move(idle.back());
        idle.pop_back();
    }
    ~Scratch() {
        list_.clear();
        lists().push_back(std::move(list_));
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    std::vector<T>& operator*() { return list_; }
    std::vector<T>* operator->() { return &list_; }

  private:
    static std::vector<std::vector<T>>& lists() {
        thread_local std::vector<std::vector<T>> idle;
        return idle;
    }
    std::vector<T> list_;
};

}  // namespace ag
