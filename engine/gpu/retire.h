// Objects that go once the device is done with them, from where nothing may be thrown.
#pragma once

#include <memory>
#include <new>

#include "engine/gpu/context.h"

namespace ag::gpu {

// If even the note cannot be allocated, the object leaks: better than to destroy it in use.
template <class T>
void retireOwned(Context& context, std::unique_ptr<T> object) noexcept {
    T* raw = object.release();
    if (!raw) return;
    try {
        context.retire([raw] { delete raw; });
    } catch (const std::bad_alloc&) {
    }
}

}  // namespace ag::gpu
