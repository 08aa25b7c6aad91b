// SPDX-License-Identifier: GPL-2.0-or-later
#include "dch_options.h"

#include <climits>
#include <cstdlib>
#include <string>
#include <vector>

#include <dch/base/error.hpp>

namespace dch::lammps {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw InvalidParameter("Illegal dch command: " + what); }

void expect_no_more(const std::vector<std::string>& words, std::size_t used) {
  if (words.size() > used)
    refuse("'" + words[used] + "' after 'dch " + words[used - 1] + "' has no meaning; remove it");
}

int parse_interval(const std::string& word) {
  char* end = nullptr;
  const long n = std::strtol(word.c_str(), &end, 10);
  if (word.empty() || *end != '\0' || n < 1 || n > INT_MAX) {
    refuse("the interval is '" + word +
           "' but has to be a whole number from 1 up; for example 'dch verify every 10'");
  }
  return static_cast<int>(n);
}

Request parse_on(const std::vector<std::string>& words) {
  Request request;
  const std::string remedy = "; give 'dch on engine dch', 'dch on engine grid' or 'dch on engine auto'";
  if (words.size() == 1) return request;
  if (words[1] == "engine") {
    if (words.size() == 2) refuse("'dch on engine' lacks its name" + remedy);
    request.engine = words[2];
    if (request.engine != "dch" && request.engine != "grid" && request.engine != "auto")
      refuse("'dch on engine' does not know '" + words[2] + "'" + remedy);
    expect_no_more(words, 3);
    return request;
  }
  if (words[1] != "c") refuse("unknown option '" + words[1] + "' of 'dch on'" + remedy);
  if (words.size() == 2) refuse("'dch on c' lacks its value, which has no effect any more; leave 'c' out");
  request.has_c = true;
  expect_no_more(words, 3);
  return request;
}

Request parse_verify(const std::vector<std::string>& words) {
  Request request;
  request.action = Request::Action::verify;
  const std::string remedy = "; give 'dch verify yes', 'dch verify no' or 'dch verify every N'";
  if (words.size() == 1) refuse("'dch verify' lacks its value" + remedy);
  if (words[1] == "yes" || words[1] == "no") {
    request.verify_every = words[1] == "yes" ? 1 : 0;
    expect_no_more(words, 2);
  } else if (words[1] == "every") {
    if (words.size() == 2) refuse("'dch verify every' lacks its interval; for example 'dch verify every 10'");
    request.verify_every = parse_interval(words[2]);
    expect_no_more(words, 3);
  } else {
    refuse("'dch verify' does not know '" + words[1] + "'" + remedy);
  }
  return request;
}

Request parse_skin(const std::vector<std::string>& words) {
  Request request;
  request.action = Request::Action::skin;
  if (words.size() == 1 || (words[1] != "auto" && words[1] != "fixed")) {
    refuse(
        (words.size() == 1 ? "'dch skin' lacks its value" : "'dch skin' does not know '" + words[1] + "'") +
        std::string("; give 'dch skin auto' or 'dch skin fixed'"));
  }
  request.tunes_skin = words[1] == "auto";
  expect_no_more(words, 2);
  return request;
}

Request parse_threads(const std::vector<std::string>& words) {
  constexpr long kMaxThreads = 1024;
  Request request;
  request.action = Request::Action::threads;
  if (words.size() == 1) refuse("'dch threads' lacks its number; for example 'dch threads 4'");
  char* end = nullptr;
  const long n = std::strtol(words[1].c_str(), &end, 10);
  if (words[1].empty() || *end != '\0' || n < 1 || n > kMaxThreads) {
    refuse("the number of threads is '" + words[1] +
           "' but has to be a whole number from 1 to 1024; for example 'dch threads 4'");
  }
  request.threads = static_cast<int>(n);
  expect_no_more(words, 2);
  return request;
}

Request parse_order(const std::vector<std::string>& words) {
  Request request;
  request.action = Request::Action::order;
  const std::string remedy = "; give 'dch order auto', 'dch order yes' or 'dch order no'";
  if (words.size() == 1) refuse("'dch order' lacks its value" + remedy);
  if (words[1] == "yes") {
    request.order_atoms = OrderAtoms::always;
  } else if (words[1] == "no") {
    request.order_atoms = OrderAtoms::never;
  } else if (words[1] != "auto") {
    refuse("'dch order' does not know '" + words[1] + "'" + remedy);
  }
  expect_no_more(words, 2);
  return request;
}

Request parse_expiry(const std::vector<std::string>& words) {
  Request request;
  request.action = Request::Action::expiry;
  const std::string remedy = "; give 'dch expiry auto', 'dch expiry exact' or 'dch expiry half'";
  if (words.size() == 1) refuse("'dch expiry' lacks its value" + remedy);
  if (words[1] == "exact") {
    request.expiry = ExpiryRule::exact;
  } else if (words[1] == "half") {
    request.expiry = ExpiryRule::half;
  } else if (words[1] != "auto") {
    refuse("'dch expiry' does not know '" + words[1] + "'" + remedy);
  }
  expect_no_more(words, 2);
  return request;
}

Request parse_styles(const std::vector<std::string>& words) {
  Request request;
  request.action = Request::Action::styles;
  if (words.size() == 1 || (words[1] != "auto" && words[1] != "no")) {
    refuse((words.size() == 1 ? "'dch styles' lacks its value"
                              : "'dch styles' does not know '" + words[1] + "'") +
           std::string("; give 'dch styles auto' or 'dch styles no'"));
  }
  request.takes_styles = words[1] == "auto";
  expect_no_more(words, 2);
  return request;
}

Request parse_precision(const std::vector<std::string>& words) {
  Request request;
  request.action = Request::Action::precision;
  if (words.size() == 1 || (words[1] != "double" && words[1] != "mixed")) {
    refuse((words.size() == 1 ? "'dch precision' lacks its value"
                              : "'dch precision' does not know '" + words[1] + "'") +
           std::string("; give 'dch precision double' or 'dch precision mixed'"));
  }
  request.precision = words[1] == "mixed" ? ForcePrecision::mixed : ForcePrecision::double_precision;
  expect_no_more(words, 2);
  return request;
}

}  // namespace

Request parse_request(const std::vector<std::string>& words) {
  const std::string remedy =
      "; give 'dch on', 'dch on engine dch|grid|auto', 'dch off', 'dch styles auto|no', 'dch stats', "
      "'dch explain', 'dch verify yes|no|every N', "
      "'dch precision double|mixed', 'dch threads N', 'dch order auto|yes|no', 'dch expiry auto|exact|half' "
      "or "
      "'dch skin auto|fixed'";
  if (words.empty()) refuse("no argument" + remedy);
  if (words[0] == "on") return parse_on(words);
  if (words[0] == "verify") return parse_verify(words);
  if (words[0] == "skin") return parse_skin(words);
  if (words[0] == "threads") return parse_threads(words);
  if (words[0] == "order") return parse_order(words);
  if (words[0] == "expiry") return parse_expiry(words);
  if (words[0] == "styles") return parse_styles(words);
  if (words[0] == "precision") return parse_precision(words);
  Request request;
  if (words[0] == "off") {
    request.action = Request::Action::off;
  } else if (words[0] == "stats") {
    request.action = Request::Action::stats;
  } else if (words[0] == "explain") {
    request.action = Request::Action::explain;
  } else {
    refuse("unknown keyword '" + words[0] + "'" + remedy);
  }
  expect_no_more(words, 1);
  return request;
}

}  // namespace dch::lammps
