// Flow around an aerofoil, NACA 0012 with a chord of 1, in a circle of 12 chords.
points = 40;  // of one side, closer together at the leading and the trailing edge
upper() = {};
lower() = {};
For i In {0:points}
  x = 0.5 * (1 - Cos(Pi * i / points));
  // The last coefficient closes the trailing edge.
  y = 0.6 * (0.2969 * Sqrt(x) - 0.1260 * x - 0.3516 * x^2 + 0.2843 * x^3 - 0.1036 * x^4);
  size = 0.012 + 0.05 * (1 - Fabs(2 * x - 1));
  If (i == 0 || i == points)
    p = newp;
    Point(p) = {x, 0, 0, size};
    upper() += p;
    lower() += p;
  Else
    p = newp;
    Point(p) = {x, y, 0, size};
    upper() += p;
    p = newp;
    Point(p) = {x, -y, 0, size};
    lower() += p;
  EndIf
EndFor
Spline(1) = upper();
Spline(2) = lower();

centre = newp;
Point(centre) = {0.5, 0, 0};
far = 12;
size = 2.2;
p = newp;
Point(p) = {0.5 + far, 0, 0, size};
Point(p + 1) = {0.5 - far, 0, 0, size};
Circle(3) = {p, centre, p + 1};
Circle(4) = {p + 1, centre, p};

Curve Loop(1) = {3, 4};
Curve Loop(2) = {1, -2};
Plane Surface(1) = {1, 2};

Physical Curve("airfoil") = {1, 2};
Physical Curve("farfield") = {3, 4};
Physical Surface("air") = {1};
Mesh.Smoothing = 0;
Mesh.Optimize = 0;
