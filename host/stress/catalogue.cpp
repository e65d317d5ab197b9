// The list of rows.
#include "host/stress/catalogue.h"

#include "host/stress/functions.h"
#include "host/stress/rows.h"

namespace parhelion::stress {
namespace {

void append(std::vector<Row>& rows, const std::vector<FunctionTest>& tests) {
    for (const FunctionTest& test : tests)
        rows.push_back({.name = test.name.empty() ? test.probe : test.name,
                        .chapter = "Functions",
                        .title = "",
                        .run = [test](StressRun& run) { return run_function_test(run, test); }});
}

} // namespace

std::vector<Row> catalogue() {
    std::vector<Row> rows;
    for (auto tests : {fresnel_functions, microfacet_functions, vector_functions,
                       intersection_functions, sampling_functions})
        append(rows, tests());
#define LIST_ROW(name, chapter, title) rows.push_back({#name, chapter, title, row_##name});
    STRESS_ROWS(LIST_ROW)
    return rows;
}

} // namespace parhelion::stress
