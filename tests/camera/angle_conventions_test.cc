// SPDX-License-Identifier: Apache-2.0
// Every convention of angles that is read or written, on three angles that differ from 0, 90 and
// each other, against rotations by SciPy 1.10 (scipy.spatial.transform.Rotation.from_euler), whose
// capital letters are intrinsic: "XYZ" is Rx Ry Rz, "ZYX" is Rz Ry Rx.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "camera/picture_facts.h"
#include "camera/pose.h"
#include "support/xmp_writer.h"

namespace ridgeline {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::XmpPacket;

Eigen::Matrix3d Rows(const std::array<double, 9>& numbers) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.data());
}

PictureFacts FactsOfXmp(const std::string& xmp) { return FactsOf({}, ParseXmp(xmp)); }

Eigen::Matrix3d RotationOf(const PictureFacts& facts) {
  return CamFromWorld(ViewAngles{facts.direction.value().heading_deg,
                                 facts.direction->pitch_deg.value(),
                                 facts.direction->roll_deg.value()})
      .toRotationMatrix();
}

constexpr double kDigits = 1e-11;  // of the numbers below

// diag(1, -1, -1) * from_euler("XYZ", [24.5, -37.25, 68.75], degrees).T
const std::array<double, 9> kOpk = {0.288501404269,
                                    0.757115012377,
                                    0.586126093744,
                                    0.741880130327,
                                    -0.563749109659,
                                    0.363043817720,
                                    0.605293988043,
                                    0.330096651592,
                                    -0.724330993847};

// diag(1, -1, -1) * from_euler("ZYX", [68.75, -37.25, 24.5], degrees).T
const std::array<double, 9> kLoeper = {0.288501404269,
                                       0.741880130327,
                                       0.605293988043,
                                       0.939067118022,
                                       -0.095860046203,
                                       -0.330096651592,
                                       -0.186868637244,
                                       0.663645028436,
                                       -0.724330993847};

// (ENU_from_NED * from_euler("ZYX", [131.5, -23.25, 7.75], degrees) * body_from_cam).T, the camera
// looking along the body's x.
const std::array<double, 9> kLooksAhead = {-0.696435702263,
                                           -0.706842372759,
                                           -0.123899849416,
                                           -0.203590281683,
                                           0.360173405518,
                                           -0.910398876955,
                                           0.688133933052,
                                           -0.608809475969,
                                           -0.394743856384};

// The same of [131.5, 66.75, 7.75], the camera looking along the body's z, its top along x.
const std::array<double, 9> kLooksDown = {-0.563772107677,
                                          -0.824213206577,
                                          -0.053231576253,
                                          -0.295645669485,
                                          0.261565193150,
                                          -0.918791210149,
                                          0.771203377016,
                                          -0.502251172061,
                                          -0.391138225494};

TEST(AngleConventions, OmegaPhiKappa) {
  const Eigen::Quaterniond q = CamFromWorld(OmegaPhiKappa{24.5, -37.25, 68.75});
  EXPECT_LT((q.toRotationMatrix() - Rows(kOpk)).norm(), kDigits);
  const OmegaPhiKappa back = OmegaPhiKappaOf(Eigen::Quaterniond(Rows(kOpk)));
  EXPECT_NEAR(back.omega_deg, 24.5, 1e-8);
  EXPECT_NEAR(back.phi_deg, -37.25, 1e-8);
  EXPECT_NEAR(back.kappa_deg, 68.75, 1e-8);
}

// Pix4D's own formulas for a matrix R = Rx Ry Rz: omega = atan(-R23 / R33), phi = asin(R13), kappa
// = atan(-R12 / R11).
TEST(AngleConventions, OmegaPhiKappaByPix4dsFormulas) {
  const Eigen::Matrix3d photo_axes = Eigen::Vector3d(1, -1, -1).asDiagonal();
  const Eigen::Matrix3d r =
      CamFromWorld(OmegaPhiKappa{-12.0, 31.0, 47.0}).toRotationMatrix().transpose() * photo_axes;
  const double deg = 180.0 / M_PI;
  EXPECT_NEAR(std::atan(-r(1, 2) / r(2, 2)) * deg, -12.0, 1e-10);
  EXPECT_NEAR(std::asin(r(0, 2)) * deg, 31.0, 1e-10);
  EXPECT_NEAR(std::atan(-r(0, 1) / r(0, 0)) * deg, 47.0, 1e-10);
}

TEST(AngleConventions, Loepers) {
  const Eigen::Quaterniond q = CamFromWorld(LoeperOmegaPhiKappa{24.5, -37.25, 68.75});
  EXPECT_LT((q.toRotationMatrix() - Rows(kLoeper)).norm(), kDigits);
  const LoeperOmegaPhiKappa back = LoeperOmegaPhiKappaOf(Eigen::Quaterniond(Rows(kLoeper)));
  EXPECT_NEAR(back.omega_deg, 24.5, 1e-8);
  EXPECT_NEAR(back.phi_deg, -37.25, 1e-8);
  EXPECT_NEAR(back.kappa_deg, 68.75, 1e-8);
}

TEST(AngleConventions, OurViewAngles) {
  const Eigen::Quaterniond q = CamFromWorld(ViewAngles{131.5, -23.25, 7.75});
  EXPECT_LT((q.toRotationMatrix() - Rows(kLooksAhead)).norm(), kDigits);
}

TEST(AngleConventions, MakersWhoseZeroLooksAhead) {
  const std::string dji =
      "xmlns:d=\"http://www.dji.com/drone-dji/1.0/\" d:GimbalYawDegree=\"+131.50\" "
      "d:GimbalPitchDegree=\"-23.25\" d:GimbalRollDegree=\"+7.75\"";
  const std::string autel =
      "xmlns:drone=\"http://www.autelrobotics.com/drone/1.0/\" drone:GimbalYawDegree=\"131.50\" "
      "drone:GimbalPitchDegree=\"-23.25\" drone:GimbalRollDegree=\"7.75\"";
  const std::string parrot =
      "xmlns:p=\"http://www.parrot.com/drone-parrot/1.0/\" p:CameraYawDegree=\"131.5\" "
      "p:CameraPitchDegree=\"-23.25\" p:CameraRollDegree=\"7.75\"";
  const std::string google =
      "xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\" "
      "GPano:PoseHeadingDegrees=\"131.5\" "
      "GPano:PosePitchDegrees=\"-23.25\" GPano:PoseRollDegrees=\"7.75\"";
  for (const std::string& attributes : {dji, autel, parrot, google}) {
    const PictureFacts facts = FactsOfXmp(XmpPacket(attributes));
    EXPECT_LT((RotationOf(facts) - Rows(kLooksAhead)).norm(), kDigits) << attributes;
    EXPECT_THAT(facts.doubts, IsEmpty());
    EXPECT_EQ(facts.from_aircraft, attributes != google);
  }
}

// In both ways that XMP has for structures; other structures of the same members lie beside.
TEST(AngleConventions, SkydiosStructures) {
  const std::string space = "xmlns:s=\"https://www.skydio.com/drone-skydio/1.0/\"";
  const std::string elements =
      "<s:VehicleOrientationNED rdf:parseType=\"Resource\"><s:Roll>1</s:Roll><s:Pitch>2</s:Pitch>"
      "<s:Yaw>3</s:Yaw></s:VehicleOrientationNED><s:CameraOrientationNED "
      "rdf:parseType=\"Resource\"><s:Roll>7.75</s:Roll><s:Pitch>-23.25</s:Pitch>"
      "<s:Yaw>131.5</s:Yaw></s:CameraOrientationNED>";
  const std::string attributes =
      "<s:CameraOrientationFLU s:Roll=\"1\" s:Pitch=\"2\" s:Yaw=\"3\"/>"
      "<s:CameraOrientationNED s:Roll=\"7.75\" s:Pitch=\"-23.25\" s:Yaw=\"131.5\"/>";
  for (const std::string& text : {elements, attributes}) {
    const PictureFacts facts = FactsOfXmp(XmpPacket(space, text));
    EXPECT_LT((RotationOf(facts) - Rows(kLooksAhead)).norm(), kDigits) << text;
    EXPECT_EQ(facts.direction->source, "Skydio's XMP");
  }
}

TEST(AngleConventions, MakersWhoseZeroLooksDown) {
  for (const char* space : {"http://pix4d.com/camera/1.0",
                            "http://pix4d.com/camera/1.0/",
                            "http://pix4d.com/Camera/1.0/",
                            "http://ns.sensefly.com/Camera/1.0/"}) {
    const PictureFacts facts = FactsOfXmp(
        XmpPacket(std::string("xmlns:Camera=\"") + space +
                  "\" Camera:Yaw=\"263/2\" Camera:Pitch=\"66.75\" Camera:Roll=\"7.75\""));
    EXPECT_LT((RotationOf(facts) - Rows(kLooksDown)).norm(), kDigits) << space;
  }
}

std::string Pix4d(double yaw, double pitch, double roll) {
  return XmpPacket("xmlns:Camera=\"http://pix4d.com/camera/1.0/\" Camera:Yaw=\"" +
                   std::to_string(yaw) + "\" Camera:Pitch=\"" + std::to_string(pitch) +
                   "\" Camera:Roll=\"" + std::to_string(roll) + "\"");
}

// A maker that writes the pitch from the horizon under Pix4D's name.
TEST(AngleDoubts, UpsideDownIsTakenAsNotTold) {
  const PictureFacts facts = FactsOfXmp(Pix4d(30, -20, 0));
  EXPECT_FALSE(facts.direction.has_value());
  EXPECT_THAT(facts.doubts,
              Contains(AllOf(HasSubstr("yaw 30, pitch -20, roll 0 in Pix4D's XMP"),
                             HasSubstr("looks to 210 deg upside down"),
                             HasSubstr("from the horizon"),
                             HasSubstr("taken as not told"))));
  // Straight down and a little past it is no fault.
  EXPECT_TRUE(FactsOfXmp(Pix4d(30, -5, 0)).direction.has_value());
  EXPECT_TRUE(FactsOfXmp(Pix4d(30, 70, 0)).direction.has_value());
}

TEST(AngleDoubts, NeverWrittenAnglesAreTakenAsNotTold) {
  const PictureFacts facts = FactsOfXmp(Pix4d(0, 0, 0));
  EXPECT_FALSE(facts.direction.has_value());
  EXPECT_THAT(facts.doubts, Contains(HasSubstr("were never written, as it seems")));
}

TEST(AngleDoubts, AbsurdNumbersAreNoAngles) {
  const PictureFacts facts = FactsOfXmp(
      XmpPacket("xmlns:d=\"http://www.dji.com/drone-dji/1.0/\" d:GimbalYawDegree=\"1e300\" "
                "d:GimbalPitchDegree=\"-20\""));
  EXPECT_FALSE(facts.direction.has_value());
  EXPECT_THAT(facts.doubts, Contains(HasSubstr("are no angles")));
}

// The next source is asked then.
TEST(AngleDoubts, DoubtedAnglesGiveWayToOthers) {
  const PictureFacts facts = FactsOfXmp(XmpPacket(
      "xmlns:d=\"http://www.dji.com/drone-dji/1.0/\" d:GimbalYawDegree=\"+0.00\" "
      "d:GimbalPitchDegree=\"+0.00\" d:GimbalRollDegree=\"+0.00\" "
      "xmlns:Camera=\"http://pix4d.com/camera/1.0/\" Camera:Yaw=\"20\" Camera:Pitch=\"70\" "
      "Camera:Roll=\"0\""));
  EXPECT_EQ(facts.direction.value().source, "Pix4D's XMP");
}

}  // namespace
}  // namespace ridgeline
