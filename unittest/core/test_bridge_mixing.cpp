// The liquid between bodies of two materials, each with a liquid of its own.

#include "contact/bridge.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace apf;

namespace {

BridgeModel water()
{
  BridgeModel liquid;
  liquid.volume_ratio = 0.01;
  liquid.sigma = 0.072;
  liquid.theta = 0.3;
  liquid.mu = 1e-3;
  liquid.roughness = 0.01;
  return liquid;
}

}    // namespace

TEST(BridgeMixing, of_one_liquid_is_that_liquid)
{
  const BridgeModel c = BridgeModel::mixed(water(), water());
  EXPECT_NEAR(c.volume_ratio, 0.01, 1e-16);
  EXPECT_NEAR(c.sigma, 0.072, 1e-15);
  EXPECT_NEAR(c.mu, 1e-3, 1e-17);
  EXPECT_NEAR(c.theta, 0.3, 1e-14);
}

TEST(BridgeMixing, lies_between_the_two_and_knows_no_order)
{
  BridgeModel oil = water();
  oil.sigma = 0.02;
  oil.mu = 0.1;
  oil.theta = 1.2;
  const BridgeModel ab = BridgeModel::mixed(water(), oil), ba = BridgeModel::mixed(oil, water());
  EXPECT_EQ(ab.sigma, ba.sigma);
  EXPECT_EQ(ab.mu, ba.mu);
  EXPECT_EQ(ab.theta, ba.theta);
  EXPECT_GT(ab.sigma, 0.02);
  EXPECT_LT(ab.sigma, 0.072);
  EXPECT_GT(ab.mu, 1e-3);
  EXPECT_LT(ab.mu, 0.1);
  // Young's equation: cos(theta) is in proportion to what wetting yields, of which this is the mean
  EXPECT_NEAR(std::cos(ab.theta), 0.5 * (std::cos(0.3) + std::cos(1.2)), 1e-15);
}

TEST(BridgeMixing, needs_liquid_on_either_side)
{
  EXPECT_FALSE(BridgeModel::mixed(water(), BridgeModel{}).present());
  EXPECT_FALSE(BridgeModel::mixed(BridgeModel{}, water()).present());
  EXPECT_TRUE(BridgeModel::mixed(water(), water()).present());
}
