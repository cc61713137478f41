// The queues a frame's work goes to.
#pragma once

#include <cstdint>

namespace ag::gpu {

// kAsync runs beside kMain where the device has a second queue for compute.
enum class Queue : uint8_t { kMain, kAsync };
constexpr uint32_t kQueues = 2;

constexpr Queue otherQueue(Queue queue) {
    return queue == Queue::kMain ? Queue::kAsync : Queue::kMain;
}

}  // namespace ag::gpu
