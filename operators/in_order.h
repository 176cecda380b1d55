// Makes pieces of work in any order, on all threads, and adds them in a fixed one: the same bits on any number of threads.
#pragma once

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>

#include <atomic>
#include <cstddef>
#include <vector>

namespace neumann {

// Calls make(k, piece), from any thread, and add(k, piece), in order of k, for k = 0 … count − 1, until add returns
// false. Returns whether all were added. Piece objects are reused.
template <class Piece, class Make, class Add>
bool add_in_order(std::size_t count, const Make& make, const Add& add) {
    struct Slot {
        std::size_t number = 0;
        Piece piece;
    };
    namespace tbb = oneapi::tbb;
    std::vector<Slot> slots(4 * static_cast<std::size_t>(tbb::info::default_concurrency()));
    std::size_t begun = 0;
    std::atomic<bool> dropped = false;
    tbb::parallel_pipeline(
        slots.size(), tbb::make_filter<void, Slot*>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) -> Slot* {
                          if (begun == count || dropped) {
                              control.stop();
                              return nullptr;
                          }
                          Slot& slot = slots[begun % slots.size()];
                          slot.number = begun++;
                          return &slot;
                      }) & tbb::make_filter<Slot*, Slot*>(tbb::filter_mode::parallel, [&](Slot* slot) {
                          if (!dropped) make(slot->number, slot->piece);
                          return slot;
                      }) & tbb::make_filter<Slot*, void>(tbb::filter_mode::serial_in_order, [&](Slot* slot) {
                          if (!dropped && !add(slot->number, slot->piece)) dropped = true;
                      }));
    return !dropped;
}

}  // namespace neumann
