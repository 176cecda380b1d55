#include "tests/search/apart.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

namespace neumann::search::processes_test {

using Lines = std::vector<std::string>;

TEST(Apart, WhatIsSaidIsHeard) {
    const Ended ended = run_apart([](Words& words) {
        words.say("one");
        words.say("two\nlines");
    });
    EXPECT_EQ(ended.lines, (Lines{"one", "two lines"}));
    EXPECT_EQ(ended.how, "");
}

TEST(Apart, ACrashIsToldAndWhatWasSaidBefore) {
    const Ended ended = run_apart([](Words& words) {
        words.say("one");
        raise(SIGSEGV);
    });
    EXPECT_EQ(ended.lines, Lines{"one"});
    EXPECT_EQ(ended.how, "died of Segmentation fault");
}

TEST(Apart, AHangIsEnded) {
    const Ended ended = run_apart([](Words&) {
        limit_time(1);
        for (volatile bool forever = true; forever;) {
        }
    });
    EXPECT_EQ(ended.how, "took too long");
}

TEST(Apart, AnExceptionIsTold) {
    EXPECT_EQ(run_apart([](Words&) { throw std::runtime_error("no"); }).how, "exception no");
}

}  // namespace neumann::search::processes_test
