// SPDX-License-Identifier: GPL-2.0-or-later
#include "dch_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>

namespace dch::lammps {
namespace {

using Words = std::vector<std::string>;

std::string message_of(const Words& words) {
  try {
    parse_request(words);
  } catch (const InvalidParameter& e) {
    return e.what();
  }
  return "no error";
}

TEST(DchOptions, On) {
  const Request request = parse_request({"on"});
  EXPECT_EQ(request.action, Request::Action::on);
  EXPECT_TRUE(parse_request({"on", "c", "1.3"}).has_c);
  EXPECT_FALSE(parse_request({"on"}).has_c);
  EXPECT_EQ(parse_request({"on"}).engine, "");
  for (const char* engine : {"dch", "grid", "auto"})
    EXPECT_EQ(parse_request({"on", "engine", engine}).engine, engine);
}

TEST(DchOptions, OffAndStats) {
  EXPECT_EQ(parse_request({"off"}).action, Request::Action::off);
  EXPECT_EQ(parse_request({"stats"}).action, Request::Action::stats);
  EXPECT_EQ(parse_request({"explain"}).action, Request::Action::explain);
}

TEST(DchOptions, Verify) {
  EXPECT_EQ(parse_request({"verify", "yes"}).action, Request::Action::verify);
  EXPECT_EQ(parse_request({"verify", "yes"}).verify_every, 1);
  EXPECT_EQ(parse_request({"verify", "no"}).verify_every, 0);
  EXPECT_EQ(parse_request({"verify", "every", "25"}).verify_every, 25);
}

TEST(DchOptions, Precision) {
  EXPECT_EQ(parse_request({"precision", "mixed"}).action, Request::Action::precision);
  EXPECT_EQ(parse_request({"precision", "mixed"}).precision, ForcePrecision::mixed);
  EXPECT_EQ(parse_request({"precision", "double"}).precision, ForcePrecision::double_precision);
}

TEST(DchOptions, Skin) {
  EXPECT_EQ(parse_request({"skin", "auto"}).action, Request::Action::skin);
  EXPECT_TRUE(parse_request({"skin", "auto"}).tunes_skin);
  EXPECT_FALSE(parse_request({"skin", "fixed"}).tunes_skin);
}

TEST(DchOptions, Order) {
  EXPECT_EQ(parse_request({"order", "yes"}).action, Request::Action::order);
  EXPECT_EQ(parse_request({"order", "yes"}).order_atoms, OrderAtoms::always);
  EXPECT_EQ(parse_request({"order", "no"}).order_atoms, OrderAtoms::never);
  EXPECT_EQ(parse_request({"order", "auto"}).order_atoms, OrderAtoms::automatic);
}

TEST(DchOptions, Expiry) {
  EXPECT_EQ(parse_request({"expiry", "exact"}).action, Request::Action::expiry);
  EXPECT_EQ(parse_request({"expiry", "exact"}).expiry, ExpiryRule::exact);
  EXPECT_EQ(parse_request({"expiry", "half"}).expiry, ExpiryRule::half);
  EXPECT_EQ(parse_request({"expiry", "auto"}).expiry, ExpiryRule::automatic);
}

TEST(DchOptions, Styles) {
  EXPECT_EQ(parse_request({"styles", "no"}).action, Request::Action::styles);
  EXPECT_FALSE(parse_request({"styles", "no"}).takes_styles);
  EXPECT_TRUE(parse_request({"styles", "auto"}).takes_styles);
}

TEST(DchOptions, Threads) {
  EXPECT_EQ(parse_request({"threads", "3"}).action, Request::Action::threads);
  EXPECT_EQ(parse_request({"threads", "3"}).threads, 3);
}

TEST(DchOptions, ErrorsNameTheWordAndTheRemedy) {
  const std::string grammar =
      "give 'dch on', 'dch on engine dch|grid|auto', 'dch off', 'dch styles auto|no', 'dch stats', "
      "'dch explain', 'dch verify yes|no|every N', "
      "'dch precision double|mixed', "
      "'dch threads N', 'dch order auto|yes|no', 'dch expiry auto|exact|half' or 'dch skin auto|fixed'";
  const std::vector<std::pair<Words, std::string>> cases{
      {{}, grammar},
      {{""}, grammar},
      {{"up"}, "unknown keyword 'up'; " + grammar},
      {{"off", "now"}, "'now' after 'dch off' has no meaning; remove it"},
      {{"on", "d"}, "unknown option 'd' of 'dch on'; give 'dch on engine dch', 'dch on engine grid'"},
      {{"on", "engine"}, "'dch on engine' lacks its name; give 'dch on engine dch'"},
      {{"on", "engine", "tree"},
       "'dch on engine' does not know 'tree'; give 'dch on engine dch', 'dch on engine grid' or 'dch on "
       "engine auto'"},
      {{"on", "engine", "grid", "c"}, "'c' after 'dch grid'"},
      {{"on", "c"}, "'dch on c' lacks its value, which has no effect any more; leave 'c' out"},
      {{"on", "c", "1.2", "c"}, "'c' after 'dch 1.2'"},
      {{"verify"},
       "'dch verify' lacks its value; give 'dch verify yes', 'dch verify no' or 'dch verify every N'"},
      {{"verify", "often"}, "does not know 'often'"},
      {{"verify", "yes", "please"}, "'please' after"},
      {{"verify", "every"}, "lacks its interval"},
      {{"verify", "every", "0"}, "the interval is '0' but has to be a whole number from 1 up"},
      {{"verify", "every", "2.5"}, "the interval is '2.5'"},
      {{"verify", "every", "99999999999999999999"}, "the interval is '99999999999999999999'"},
      {{"expiry"},
       "'dch expiry' lacks its value; give 'dch expiry auto', 'dch expiry exact' or 'dch expiry half'"},
      {{"expiry", "never"}, "'dch expiry' does not know 'never'; give 'dch expiry auto'"},
      {{"expiry", "half", "on"}, "'on' after"},
      {{"styles"}, "'dch styles' lacks its value; give 'dch styles auto' or 'dch styles no'"},
      {{"styles", "mine"}, "'dch styles' does not know 'mine'"},
      {{"styles", "no", "fix"}, "'fix' after 'dch no'"},
      {{"skin"}, "lacks its value; give 'dch skin auto' or 'dch skin fixed'"},
      {{"skin", "0.3"}, "does not know '0.3'"},
      {{"skin", "auto", "on"}, "'on' after"},
      {{"order"}, "lacks its value; give 'dch order auto', 'dch order yes' or 'dch order no'"},
      {{"order", "random"}, "does not know 'random'"},
      {{"order", "no", "thanks"}, "'thanks' after 'dch no'"},
      {{"threads"}, "lacks its number; for example 'dch threads 4'"},
      {{"threads", "0"}, "the number of threads is '0' but has to be a whole number from 1 to 1024"},
      {{"threads", "two"}, "the number of threads is 'two'"},
      {{"threads", "1025"}, "the number of threads is '1025'"},
      {{"threads", "2", "3"}, "'3' after"},
      {{"precision"}, "lacks its value; give 'dch precision double' or 'dch precision mixed'"},
      {{"precision", "single"}, "does not know 'single'; give 'dch precision double'"},
      {{"precision", "mixed", "up"}, "'up' after 'dch mixed'"},
  };
  for (const auto& [words, message] : cases) {
    EXPECT_THAT(message_of(words), testing::StartsWith("Illegal dch command: "));
    EXPECT_THAT(message_of(words), testing::HasSubstr(message));
  }
}

}  // namespace
}  // namespace dch::lammps
