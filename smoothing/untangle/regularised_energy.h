// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "trismooth/base/point2.h"

namespace trismooth {

/// What a triangle is to look like: isosceles, of some height over its base.
struct IdealTriangle {
  /// How its corners come into t below (e: 1, -1/2, -1/2): by the height as a part of the base.
  std::array<double, 3> into_t;
  double area;    ///< where |p|^2 - |q|^2 (below) is 1: 3/8 of the base to the height
  double weight;  ///< what it counts in the energy of a mesh

  static const IdealTriangle equilateral;
  /// The corner of a square, from there on, with the ends of its sides: a quadrilateral has four.
  static const IdealTriangle corner;
};
inline constexpr IdealTriangle IdealTriangle::equilateral{
    {0, 0.5 * std::numbers::sqrt3, -0.5 * std::numbers::sqrt3}, 0.25 * std::numbers::sqrt3, 1};
inline constexpr IdealTriangle IdealTriangle::corner{{0, 0.5, -0.5}, 0.75, 0.5};

/// The regularised energy of one triangle, finite where it is inverted, too (V. Garanzha, I. Kaporin, L. Kudryavtseva,
/// F. Protais, N. Ray, D. Sokolov: Foldover-free maps in 50 lines of code, 2021):
///
///     f = S / (2 A* X) + lambda (1 + D^2) / X,   D = A / A*,   X = (D + sqrt(eps^2 + D^2)) / 2
///
/// S / 2 = |J|^2 A* for the map J from the ideal triangle of area A* to this one, A its area. With eps = 0 the first
/// term is 2 / alpha, or in the corner of a quadrilateral 2 / corner_shape(); with eps > 0 both are smooth everywhere
/// and large where D < 0. All is times the weight of the ideal triangle.
///
/// It is written in e = z0 - (z1 + z2) / 2 and t = h J (z1 - z2), with h the height of the ideal triangle over its
/// base, sqrt(3)/2 or 1/2, and J the turn by 90 degrees to the left: p = (e - t) / sqrt(3) is the part of the triangle
/// that is similar to the ideal one, q = (e + t) / sqrt(3) the part that is similar to its mirror image. A is 3/(8 h)
/// (|p|^2 - |q|^2), and f depends on |p|^2 and |q|^2 alone. So the Hessian splits into what is across p, across q and
/// along both (2 x 2), and its positive part is found in closed form.
struct RegularisedEnergy {
  double epsilon = 0;
  double size_weight = 0;  ///< lambda

  static constexpr double root3 = std::numbers::sqrt3;

  /// A triangle in the coordinates of the energy.
  struct Shape {
    Point2<double> p;
    Point2<double> q;
    double scale;      ///< what |p|^2 - |q|^2 times this is D
    double weight;     ///< of the ideal triangle
    double squared_p;  ///< times scale, as squared_q: D is their difference
    double squared_q;
    double determinant;
  };

  /// First and second derivatives by e and t; the second ones with their positive part alone.
  struct Derivatives {
    double value;
    Point2<double> by_e;
    Point2<double> by_t;
    double ee[3];  ///< xx, xy, yy
    double et[4];  ///< xx, xy, yx, yy
    double tt[3];
  };

  static Shape shape_of(Point2<double> z0, Point2<double> z1, Point2<double> z2, double target_area,
                        const IdealTriangle& ideal = IdealTriangle::equilateral) {
    const Point2<double> e{0.5 * ((z0.x - z1.x) + (z0.x - z2.x)), 0.5 * ((z0.y - z1.y) + (z0.y - z2.y))};
    const Point2<double> d = z1 - z2;
    const Point2<double> t{ideal.into_t[2] * d.y, ideal.into_t[1] * d.x};
    Shape shape;
    shape.p = {(e.x - t.x) / root3, (e.y - t.y) / root3};
    shape.q = {(e.x + t.x) / root3, (e.y + t.y) / root3};
    shape.scale = ideal.area / target_area;
    shape.weight = ideal.weight;
    shape.squared_p = shape.scale * squared_length(shape.p);
    shape.squared_q = shape.scale * squared_length(shape.q);
    // Of cross(), not of p and q: that would lose the digits of a sliver.
    shape.determinant = 0.5 * cross(z1 - z0, z2 - z0) / target_area;
    return shape;
  }

  double root_of(double determinant) const { return std::sqrt(epsilon * epsilon + determinant * determinant); }
  /// X.
  double regularised(double determinant) const {
    const double root = root_of(determinant);
    return determinant > 0 ? 0.5 * (determinant + root) : 0.5 * epsilon * epsilon / (root - determinant);
  }

  double value(const Shape& shape) const {
    const double x = regularised(shape.determinant);
    return shape.weight *
           ((2 * (shape.squared_p + shape.squared_q) + size_weight * (1 + shape.determinant * shape.determinant)) / x);
  }

  Derivatives derivatives(const Shape& shape) const {
    const double determinant = shape.determinant;
    const double root = root_of(determinant);
    const double x = regularised(determinant);
    const double x1 = x / root;                                          // dX/dD
    const double x2 = 0.5 * (epsilon / root) * (epsilon / root) / root;  // d2X/dD2
    const double squares = shape.squared_p + shape.squared_q;
    const double numerator = 2 * squares + size_weight * (1 + determinant * determinant);
    const double numerator1 = 2 * size_weight * determinant;
    const double u = x1 / x;
    const double g_i = 2 / x;
    const double g_d = (numerator1 - numerator * u) / x;
    const double g_id = -2 * u / x;
    const double g_dd = (2 * size_weight - 2 * numerator1 * u + numerator * (2 * u * u - x2 / x)) / x;
    // By the squares of p and q: f_p, f_q, f_pp, f_pq, f_qq.
    const double f_p = g_i + g_d;
    const double f_q = g_i - g_d;
    const double length_p = std::sqrt(shape.squared_p);
    const double length_q = std::sqrt(shape.squared_q);
    // Along p and q.
    double a = 2 * f_p + 4 * shape.squared_p * (2 * g_id + g_dd);
    double b = -4 * length_p * length_q * g_dd;
    double c = 2 * f_q + 4 * shape.squared_q * (g_dd - 2 * g_id);
    double across_p = 2 * f_p;
    double across_q = 2 * f_q;
    make_positive(a, b, c, across_p, across_q);

    const double scale = shape.weight * shape.scale;
    const Point2<double> unit_p = unit(shape.p);
    const Point2<double> unit_q = unit(shape.q);
    Derivatives result;
    result.value = shape.weight * (numerator / x);
    const double gradient_p = 2 * f_p * scale;
    const double gradient_q = 2 * f_q * scale;
    const Point2<double> by_p{gradient_p * shape.p.x, gradient_p * shape.p.y};
    const Point2<double> by_q{gradient_q * shape.q.x, gradient_q * shape.q.y};
    result.by_e = {(by_q.x + by_p.x) / root3, (by_q.y + by_p.y) / root3};
    result.by_t = {(by_q.x - by_p.x) / root3, (by_q.y - by_p.y) / root3};
    const double third = scale / 3;
    // Products of x and y first: a triangle that is turned by a right angle has the same bits.
    const double pp[3] = {across_p + (a - across_p) * (unit_p.x * unit_p.x), (a - across_p) * (unit_p.x * unit_p.y),
                          across_p + (a - across_p) * (unit_p.y * unit_p.y)};
    const double qq[3] = {across_q + (c - across_q) * (unit_q.x * unit_q.x), (c - across_q) * (unit_q.x * unit_q.y),
                          across_q + (c - across_q) * (unit_q.y * unit_q.y)};
    const double pq[4] = {b * unit_p.x * unit_q.x, b * unit_p.x * unit_q.y, b * unit_p.y * unit_q.x,
                          b * unit_p.y * unit_q.y};
    const double mixed[3] = {2 * pq[0], pq[1] + pq[2], 2 * pq[3]};
    for (int i = 0; i < 3; ++i) {
      result.ee[i] = third * (pp[i] + qq[i] + mixed[i]);
      result.tt[i] = third * (pp[i] + qq[i] - mixed[i]);
    }
    // e = (p + q) sqrt(3)/2 and t = (q - p) sqrt(3)/2: d/de has both with a plus, d/dt has p with a minus.
    const double skew = pq[1] - pq[2];
    result.et[0] = third * (qq[0] - pp[0]);
    result.et[1] = third * (qq[1] - pp[1] + skew);
    result.et[2] = third * (qq[1] - pp[1] - skew);
    result.et[3] = third * (qq[2] - pp[2]);
    return result;
  }

 private:
  static Point2<double> unit(Point2<double> v) {
    const double length = std::sqrt(squared_length(v));
    return length > 0 ? Point2<double>{v.x / length, v.y / length} : Point2<double>{0, 0};
  }

  /// The four eigenvalues are brought up to a small part of the largest.
  static void make_positive(double& a, double& b, double& c, double& across_p, double& across_q) {
    const double mean = 0.5 * (a + c);
    const double half = 0.5 * (a - c);
    const double radius = std::sqrt(half * half + b * b);
    double largest = mean + radius;
    largest = largest > across_p ? largest : across_p;
    largest = largest > across_q ? largest : across_q;
    const double least = 1e-7 * largest;
    across_p = across_p > least ? across_p : least;
    across_q = across_q > least ? across_q : least;
    const double low = mean - radius;
    const double high = mean + radius;
    if (low >= least || !(radius > 0)) {
      if (!(radius > 0) && !(low >= least)) {
        a = c = least;
        b = 0;
      }
      return;
    }
    const double new_low = least;
    const double new_high = high > least ? high : least;
    const double new_mean = 0.5 * (new_high + new_low);
    const double factor = 0.5 * (new_high - new_low) / radius;
    a = new_mean + factor * half;
    c = new_mean - factor * half;
    b *= factor;
  }
};

}  // namespace trismooth
