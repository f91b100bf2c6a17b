// Linked with the C++ tests and a library compiled with -finstrument-functions, by
// tests/fuzz/mutate.sh: which functions of the library each test case enters. HARMORPH_REACH names
// the file that gets, for each case, a line "case" with the seconds of the processor, the file and
// the name, and the addresses of the functions, one a line.
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

extern "C" const char __executable_start, etext;

namespace {

// One mark for each byte of the program's code. Functions may be entered before it is made.
std::vector<char>* marks = nullptr;

struct Reach : doctest::IReporter {
    explicit Reach(doctest::ContextOptions const&) {
        if (const char* const name = std::getenv("HARMORPH_REACH")) {
            file = std::fopen(name, "w");
            marks = new std::vector<char>(&etext - &__executable_start);
        }
    }
    ~Reach() override {
        if (file != nullptr) std::fclose(file);
    }
    void test_case_start(doctest::TestCaseData const& data) override {
        name = data.m_name;
        source = data.m_file.c_str();
        begun = std::clock();
    }
    void test_case_end(doctest::CurrentTestCaseStats const&) override {
        if (file == nullptr) return;
        double const taken = double(std::clock() - begun) / CLOCKS_PER_SEC;
        std::fprintf(file, "case\t%.3f\t%s\t%s\n", taken, source, name);
        for (std::size_t k = 0; k < marks->size(); ++k) {
            if ((*marks)[k]) std::fprintf(file, "%p\n", &__executable_start + k);
            (*marks)[k] = 0;
        }
    }

    void report_query(doctest::QueryData const&) override {}
    void test_run_start() override {}
    void test_run_end(doctest::TestRunStats const&) override {}
    void test_case_reenter(doctest::TestCaseData const&) override {}
    void test_case_exception(doctest::TestCaseException const&) override {}
    void subcase_start(doctest::SubcaseSignature const&) override {}
    void subcase_end() override {}
    void log_assert(doctest::AssertData const&) override {}
    void log_message(doctest::MessageData const&) override {}
    void test_case_skipped(doctest::TestCaseData const&) override {}

    std::FILE* file = nullptr;
    const char *name = "", *source = "";
    std::clock_t begun = 0;
};
REGISTER_LISTENER("reach", 1, Reach);

}  // namespace

extern "C" void __cyg_profile_func_enter(void* function, void*) {
    if (marks != nullptr) (*marks)[static_cast<const char*>(function) - &__executable_start] = 1;
}
extern "C" void __cyg_profile_func_exit(void*, void*) {}
