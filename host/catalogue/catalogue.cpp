// The list of rows.
#include "host/catalogue/catalogue.h"

#include "host/catalogue/functions.h"
#include "host/catalogue/rows.h"

namespace parhelion::stress {
namespace {

std::string measures_of(const FunctionTest& test) {
    std::string text;
    for (const Measure& measure : test.measures)
        text += (text.empty() ? "" : "; ") + measure.name;
    return text;
}

void append(std::vector<Row>& rows, const std::vector<FunctionTest>& tests) {
    for (const FunctionTest& test : tests)
        rows.push_back({.name = test.name.empty() ? test.probe : test.name,
                        .chapter = "Functions",
                        .title = "Against a higher precision: " + measures_of(test),
                        .run = [test](StressRun& run) { return run_function_test(run, test); }});
}

} // namespace

std::vector<Row> catalogue() {
    std::vector<Row> rows;
    for (auto tests :
         {fresnel_functions, microfacet_functions, vector_functions, intersection_functions,
          cylinder_functions, sampling_functions, normals_functions})
        append(rows, tests());
#define LIST_ROW(name, ways, chapter, title)                                                       \
    rows.push_back({#name, chapter, title, Ways::ways, row_##name});
    STRESS_ROWS(LIST_ROW)
    return rows;
}

} // namespace parhelion::stress
