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
    struct Place {
        std::size_t number = 0;
        Piece piece;
    };
    namespace tbb = oneapi::tbb;
    std::vector<Place> places(4 * static_cast<std::size_t>(tbb::info::default_concurrency()));
    std::size_t begun = 0;
    std::atomic<bool> dropped = false;
    tbb::parallel_pipeline(
        places.size(), tbb::make_filter<void, Place*>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) -> Place* {
                           if (begun == count || dropped) {
                               control.stop();
                               return nullptr;
                           }
                           Place& place = places[begun % places.size()];
                           place.number = begun++;
                           return &place;
                       }) & tbb::make_filter<Place*, Place*>(tbb::filter_mode::parallel, [&](Place* place) {
                           if (!dropped) make(place->number, place->piece);
                           return place;
                       }) & tbb::make_filter<Place*, void>(tbb::filter_mode::serial_in_order, [&](Place* place) {
                           if (!dropped && !add(place->number, place->piece)) dropped = true;
                       }));
    return !dropped;
}

}  // namespace neumann
