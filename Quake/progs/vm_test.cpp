#include "progs/vm.h"

#include <gmock/gmock.h>

#include "progs/test_qc.h"

namespace fb::progs {
namespace {

using ::testing::HasSubstr;

class VmTest : public testing::QcTest {
 protected:
  void SetUp() override {
    QcTest::SetUp();
    if (!has_compiler()) GTEST_SKIP() << testing::no_compiler();
  }
};

TEST_F(VmTest, RunsAFunction) { EXPECT_EQ(output_of("void() main = { put(1 + 2); puts(\"a\"); };"), "3 [a]"); }

TEST_F(VmTest, CallsAndRestoresLocals) {
  EXPECT_EQ(output_of(R"(
    float(float n) fib = { if (n < 2) return n; return fib(n - 1) + fib(n - 2); };
    void() main = { put(fib(15)); };
  )"),
            "610");
}

TEST_F(VmTest, StopsWhatNeverEnds) {
  options_.max_statements = 100000;
  EXPECT_THAT(output_of("void() main = { while (1) { } };"), HasSubstr("more than 100000 statements"));
}

TEST_F(VmTest, StopsRecursionWithoutEnd) {
  ASSERT_TRUE(start("void() deeper = { deeper(); }; void() main = { deeper(); };"));
  EXPECT_THAT(error_of(), HasSubstr("stack overflow"));
  EXPECT_THAT(vm_->backtrace(), HasSubstr("test.qc : deeper, statement "));
  EXPECT_THAT(vm_->backtrace(), HasSubstr("test.qc : main, statement "));
  EXPECT_FALSE(vm_->running());
}

}  // namespace
}  // namespace fb::progs
