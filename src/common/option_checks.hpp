#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace dim {

/// Refuses an option's value that is not `KEY=VALUE`; `form` is how the message calls it.
CLI::Validator pair_of(const std::string& form);

/// The same where the value must be a finite number of at least 0.
CLI::Validator pair_with_factor(const std::string& form);

/// A finite number within low..high, the ends included or, where `low_open`, without the lower one.
CLI::Validator number_within(double low, double high, bool low_open = false);

/// A share written as `2%` or `0.02`, above 0 and at most 50 %.
CLI::Validator share_or_percent();
/// The share that such a text says.
double share_of(const std::string& text);

/// Seconds above 0, written as `10`, `10s`, `500ms`, `2min` or `1h`.
CLI::Validator seconds_text();
/// The seconds that such a text says.
double seconds_of(const std::string& text);

/// Refuses options that were given and change nothing in this call.
/// @param needs  "without --tone falsecolour"
/// @throws UsageError
void refuse_without_effect(const CLI::App& command, std::initializer_list<const char*> options,
                           const std::string& needs);

/// Refuses to write a zone and its lights into one stream, paths being "-".
/// @throws UsageError
void refuse_both_on_stdout(const std::string& zone, const std::string& lights);

}  // namespace dim
