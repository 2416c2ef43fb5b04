// Flow around a two-element high-lift section: a NACA 4412 aerofoil of chord 1 with a slotted flap (NACA 0012, chord
// 0.3, 25 degrees), in a circle of radius 40. Elements are graded from 0.002 at the tails to 6.5 outside.

far = 40;
far_size = 6.5;
flap_chord = 0.3;
flap_angle = 25 * Pi / 180;
flap_x = 1.005;
flap_y = -0.022;
stations = 28;  // points on each side of a section

// A section of four-digit NACA form with a closed tail: camber `camber` at `place`, thickness `thick`, scaled by
// `chord`, turned down by `angle`, nose at (nose_x, nose_y). Curves: `upper` from tail to nose, `lower` back.
Macro Section
  first = newp;
  For i In {0:2 * stations - 1}
    turn = Pi * i / stations;
    x = 0.5 * (1 + Cos(turn));
    half = 5 * thick * (0.2969 * Sqrt(x) - 0.1260 * x - 0.3516 * x^2 + 0.2843 * x^3 - 0.1036 * x^4);
    line = 0;
    slope = 0;
    If (camber > 0)
      If (x < place)
        line = camber / place^2 * (2 * place * x - x^2);
        slope = 2 * camber / place^2 * (place - x);
      Else
        line = camber / (1 - place)^2 * (1 - 2 * place + 2 * place * x - x^2);
        slope = 2 * camber / (1 - place)^2 * (place - x);
      EndIf
    EndIf
    side = (i <= stations) ? 1 : -1;
    u = x - side * half * Sin(Atan(slope));
    v = line + side * half * Cos(Atan(slope));
    // Smallest at the nose, small at the tail.
    size = Sqrt(chord) * (0.0035 + 0.0150 * Sin(turn)^2 + 0.0025 * x);
    Point(first + i) = {nose_x + chord * (u * Cos(angle) + v * Sin(angle)),
                        nose_y + chord * (v * Cos(angle) - u * Sin(angle)), 0, size};
  EndFor
  upper = newl;
  Spline(upper) = {first:first + stations};
  lower = newl;
  Spline(lower) = {first + stations:first + 2 * stations - 1, first};
  loop = newll;
  Curve Loop(loop) = {upper, lower};
Return

chord = 1;
angle = 0;
nose_x = 0;
nose_y = 0;
thick = 0.12;
camber = 0.04;
place = 0.4;
Call Section;
wing_loop = loop;
wing[] = {upper, lower};

chord = flap_chord;
angle = flap_angle;
nose_x = flap_x;
nose_y = flap_y;
thick = 0.12;
camber = 0;
Call Section;
flap_loop = loop;
flap[] = {upper, lower};

p = newp;
Point(p) = {0.6, 0, 0, far_size};
Point(p + 1) = {0.6 + far, 0, 0, far_size};
Point(p + 2) = {0.6, far, 0, far_size};
Point(p + 3) = {0.6 - far, 0, 0, far_size};
Point(p + 4) = {0.6, -far, 0, far_size};
l = newl;
Circle(l) = {p + 1, p, p + 2};
Circle(l + 1) = {p + 2, p, p + 3};
Circle(l + 2) = {p + 3, p, p + 4};
Circle(l + 3) = {p + 4, p, p + 1};
far_loop = newll;
Curve Loop(far_loop) = {l:l + 3};
Plane Surface(1) = {far_loop, wing_loop, flap_loop};

// Elements grow with the distance from the walls, more slowly in the wake.
Field[1] = Distance;
Field[1].CurvesList = {wing[], flap[]};
Field[1].NNodesByEdge = 400;
Field[2] = MathEval;
Field[2].F = "0.0050 + 0.19 * F1";
Field[3] = Ball;
Field[3].XCenter = 1.9;
Field[3].YCenter = -0.2;
Field[3].Radius = 0.75;
Field[3].Thickness = 2.5;
Field[3].VIn = 0.07;
Field[3].VOut = far_size;
Field[4] = Min;
Field[4].FieldsList = {2, 3};
Background Field = 4;

Physical Curve("wing", 1) = {wing[]};
Physical Curve("flap", 2) = {flap[]};
Physical Curve("far field", 3) = {l:l + 3};
Physical Surface("air", 4) = {1};

Mesh.Algorithm = 5;  // Delaunay
Mesh.Smoothing = 0;
Mesh.Optimize = 0;
