// A wall bracket cut from steel plate: an L with rounded corners, bolt holes, a slotted hole for adjustment and the
// bore of a bearing. Millimetres.

foot = 230;       // length of the foot
stem = 210;       // height of the stem
leg = 70;         // width of both
corner = 14;      // radius of the outer corners
fillet = 26;      // radius of the inner corner
coarse = 6.8;
fine = 1.8;

// Outline, counter-clockwise.
Point(1) = {corner, 0, 0, 0.6 * coarse};
Point(2) = {foot - corner, 0, 0, 0.6 * coarse};
Point(3) = {foot - corner, corner, 0, coarse};
Point(4) = {foot, corner, 0, 0.6 * coarse};
Point(5) = {foot, leg - corner, 0, 0.6 * coarse};
Point(6) = {foot - corner, leg - corner, 0, coarse};
Point(7) = {foot - corner, leg, 0, 0.6 * coarse};
Point(8) = {leg + fillet, leg, 0, 0.45 * coarse};
Point(9) = {leg + fillet, leg + fillet, 0, coarse};
Point(10) = {leg, leg + fillet, 0, 0.45 * coarse};
Point(11) = {leg, stem - corner, 0, 0.6 * coarse};
Point(12) = {leg - corner, stem - corner, 0, coarse};
Point(13) = {leg - corner, stem, 0, 0.6 * coarse};
Point(14) = {corner, stem, 0, 0.6 * coarse};
Point(15) = {corner, stem - corner, 0, coarse};
Point(16) = {0, stem - corner, 0, 0.6 * coarse};
Point(17) = {0, corner, 0, 0.6 * coarse};
Point(18) = {corner, corner, 0, coarse};
Line(1) = {1, 2};
Circle(2) = {2, 3, 4};
Line(3) = {4, 5};
Circle(4) = {5, 6, 7};
Line(5) = {7, 8};
Circle(6) = {8, 9, 10};
Line(7) = {10, 11};
Circle(8) = {11, 12, 13};
Line(9) = {13, 14};
Circle(10) = {14, 15, 16};
Line(11) = {16, 17};
Circle(12) = {17, 18, 1};
Curve Loop(1) = {1:12};

loops[] = {1};

// A hole: x, y and radius in, size of the elements at its rim in `size`.
Macro RoundHole
  p = newp;
  Point(p) = {x, y, 0, size};
  Point(p + 1) = {x + radius, y, 0, size};
  Point(p + 2) = {x, y + radius, 0, size};
  Point(p + 3) = {x - radius, y, 0, size};
  Point(p + 4) = {x, y - radius, 0, size};
  l = newl;
  Circle(l) = {p + 1, p, p + 2};
  Circle(l + 1) = {p + 2, p, p + 3};
  Circle(l + 2) = {p + 3, p, p + 4};
  Circle(l + 3) = {p + 4, p, p + 1};
  loop = newll;
  Curve Loop(loop) = {l:l + 3};
  loops[] += {loop};
Return

// Bolts M10 in the foot, M8 in the stem.
radius = 5.5;
size = fine;
x = 118; y = 20;
Call RoundHole;
x = 118; y = 50;
Call RoundHole;
x = 206; y = 20;
Call RoundHole;
x = 206; y = 50;
Call RoundHole;
radius = 4.5;
x = 20; y = 186;
Call RoundHole;
x = 50; y = 186;
Call RoundHole;
// The bearing's bore and the holes of its cover.
radius = 19;
size = 1.6 * fine;
x = 38; y = 40;
Call RoundHole;
radius = 2.1;
size = 0.75 * fine;
For i In {0:3}
  x = 38 + 26 * Cos(Pi / 4 + i * Pi / 2);
  y = 40 + 26 * Sin(Pi / 4 + i * Pi / 2);
  Call RoundHole;
EndFor
// A hole to hang it by, between the bolts of the foot.
radius = 9;
size = fine;
x = 162; y = 35;
Call RoundHole;

// The slotted hole in the stem.
half = 20;
width = 6.5;
p = newp;
Point(p) = {35, 134 - half, 0, fine};
Point(p + 1) = {35, 134 + half, 0, fine};
Point(p + 2) = {35 - width, 134 - half, 0, fine};
Point(p + 3) = {35, 134 - half - width, 0, fine};
Point(p + 4) = {35 + width, 134 - half, 0, fine};
Point(p + 5) = {35 + width, 134 + half, 0, fine};
Point(p + 6) = {35, 134 + half + width, 0, fine};
Point(p + 7) = {35 - width, 134 + half, 0, fine};
l = newl;
Circle(l) = {p + 2, p, p + 3};
Circle(l + 1) = {p + 3, p, p + 4};
Line(l + 2) = {p + 4, p + 5};
Circle(l + 3) = {p + 5, p + 1, p + 6};
Circle(l + 4) = {p + 6, p + 1, p + 7};
Line(l + 5) = {p + 7, p + 2};
loop = newll;
Curve Loop(loop) = {l:l + 5};
loops[] += {loop};

Plane Surface(1) = {loops[]};
Physical Surface("plate", 1) = {1};

Mesh.Algorithm = 5;  // Delaunay
Mesh.Smoothing = 0;
Mesh.Optimize = 0;
