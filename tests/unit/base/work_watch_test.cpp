#include "harness/base/work_watch.h"

#include <gtest/gtest.h>

using namespace crossray;

TEST(WorkWatch, hearsOfItsOwnThreadAlone)
{
    WorkWatch outer, inner;
    noteWork(1, 2); // nobody watches
    {
        const WatchedWork watched(outer);
        noteWork(3, 4);
        {
            const WatchedWork nested(inner);
            noteWork(5, 6);
        }
        outer.begin("rows", 9);
        noteWork(7, 9);
    }
    noteWork(8, 9);
    EXPECT_EQ(outer.progress().what, "rows");
    EXPECT_EQ(outer.progress().done, 7u);
    EXPECT_EQ(outer.progress().total, 9u);
    EXPECT_EQ(inner.progress().done, 5u);
}

TEST(WorkWatch, endsTheWorkAtItsNextWord)
{
    WorkWatch watch;
    const WatchedWork watched(watch);
    noteWork(0, 1);
    watch.cancel();
    EXPECT_THROW(noteWork(0, 1), WorkCancelled);
    EXPECT_THROW(watch.begin("more"), WorkCancelled);
}
