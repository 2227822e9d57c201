// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/results/results.hpp"

/// Files beside results.json; they exist without Python, except the page.
namespace tripoint {

/// The Python that draws and exports: that of the variable TRIPOINT_PYTHON, else Debian's.
[[nodiscard]] std::string python_program();

/// JUnit XML: a suite a case, a test a gate, and a test for each engine that did not run. Inconclusive is a
/// failure of a type of its own.
[[nodiscard]] std::string junit_text(const Results&);

/// Markdown for a CI job's summary: the verdict, a row a case, and every gate that is not green with its
/// reason and line.
[[nodiscard]] std::string summary_text(const Results&);

/// Writes results.json, junit.xml and summary.md into the folder; a page of older results is removed. @throws
/// EngineError when a file cannot be written
void write_results(const Results&, const std::string& folder);

/// The same, then asks the report program for index.html.
/// @return why the page could not be made; empty when it is there. @throws EngineError when a file cannot be
/// written
[[nodiscard]] std::string write_report(const Results&, const std::string& folder, bool pdf = false);

/// Puts results.json of an earlier call aside as results.previous.json, and removes the files that were made
/// from it: nothing of it is taken for new.
void set_aside_report(const std::string& folder);

/// The line that ends every validation: `verdict PASS exit 0  report/index.html`; without a page it names
/// results.json.
[[nodiscard]] std::string last_line(const Results&, const std::string& folder);

/// Text above the last line. It has faults of the results as a whole, and the engines that are missing or not
/// judged, with the number of cases.
[[nodiscard]] std::string notes_text(const Results&);

/// One line for a case: its verdict, id and the gates that are not green.
[[nodiscard]] std::string case_line(const CaseResult&);

}  // namespace tripoint
