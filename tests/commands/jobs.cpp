// Work that is done in parallel: all of it is done, and of several failures the same one is told each time.
#include "apps/output/files/jobs.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace neumann::jobs_test {

TEST(Jobs, AllAreDoneAndNoMoreAtOnceThanMayBe) {
    std::atomic<int> done = 0, under_way = 0, most = 0;
    const std::vector<std::function<void()>> jobs(100, [&] {
        int seen = most;
        for (const int now = ++under_way; now > seen && !most.compare_exchange_weak(seen, now);) {
        }
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        --under_way;
        ++done;
    });
    run_jobs(jobs, 2);
    EXPECT_EQ(done, 100);
    EXPECT_LE(most, 2);
    run_jobs({}, 1);
}

TEST(Jobs, TheFirstFailureInOrderIsThrown) {
    for (int repeat = 0; repeat < 50; ++repeat) {
        std::vector<std::function<void()>> jobs;
        for (int i = 0; i < 20; ++i)
            jobs.emplace_back([i] {
                // The later of the two that fail is the faster one.
                if (i == 3) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                if (i == 3 || i == 4) throw std::runtime_error(std::to_string(i));
            });
        try {
            run_jobs(jobs, 8);
            FAIL();
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "3");
        }
    }
}

}  // namespace neumann::jobs_test
