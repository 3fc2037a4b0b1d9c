(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* What the theories define of the code in C, as a program: Flocq's doubles, computed with integers. *)
From Coq Require Import ZArith List Extraction ExtrOcamlBasic ExtrOcamlZBigInt.
From Coq Require SpecFloat Zpower.
From Flocq Require Import IEEE754.Binary IEEE754.Bits.
From Dyadel Require FiltersOrient FiltersIncircle FiltersIncircleAt FiltersIncircleNear FiltersSmall FiltersSlack
  FiltersDirection FiltersDirectionBox FiltersFarther FiltersInterval FiltersIntervalSign FiltersIntervalRoot
  FiltersIntervalCircle FiltersCell FiltersExpr FiltersExprPower FiltersGrid FiltersScale FiltersNearCode FiltersNearHull
  FiltersStar FiltersStarWitness FiltersFixed AreaDouble AreaDoubleHull AreaRound Surd Circles CirclesRadius.
From Dyadel Require Import FiltersBase FiltersDistance.

Extract Constant Z.ltb => "Big_int_Z.lt_big_int".
Extract Constant Z.leb => "Big_int_Z.le_big_int".
Extract Constant Z.sqrtrem => "Quick.root".
Extract Constant SpecFloat.digits2_pos => "Quick.bits".
Extract Constant Zpower.shift_pos => "Quick.shift_left".
Extract Constant SpecFloat.shr => "(fun x e n ->
  if Big_int_Z.sign_big_int n <= 0 then (x, e) else
  let (m, r, s) = Quick.shift_right x.shr_m x.shr_r x.shr_s n in
  ({ shr_m = m; shr_r = r; shr_s = s }, Big_int_Z.add_big_int e n))".

Definition is_nan_double (x : binary64) : bool := is_nan 53 1024 x.
Definition box (a b c d : binary64) : bbox := Build_bbox a b c d.
Definition box_ends (b : bbox) : list binary64 := e0 b :: e1 b :: e2 b :: e3 b :: nil.
Definition iv_of (a b : binary64) : FiltersInterval.iv := FiltersInterval.Build_iv a b.
Definition iv_ends (a : FiltersInterval.iv) : list binary64 := FiltersInterval.lo a :: FiltersInterval.hi a :: nil.

(* Names that several theories have. *)
Module Plane.
  Definition lift := FiltersIncircle.lift.
  Definition cross := FiltersIncircle.cross.
  Definition answer := FiltersBase.answer.
  Definition fmin := FiltersDirectionBox.fmin.
End Plane.
Module Fixed.
  Definition product := FiltersFixed.product.
  Definition sum := FiltersFixed.sum.
End Fixed.
Module Area.
  Definition axis (a0 a1 b0 b1 : binary64) := AreaDoubleHull.axis_made a0 a1 b0 b1.
  Definition ends (x : AreaDoubleHull.daxis) : list AreaDouble.dd :=
    AreaDoubleHull.dwa x :: AreaDoubleHull.dwb x :: AreaDoubleHull.dlow x :: AreaDoubleHull.dhigh x :: nil.
  Definition flags (x : AreaDoubleHull.daxis) : list bool :=
    AreaDoubleHull.db_low x :: AreaDoubleHull.db_high x :: AreaDoubleHull.axis_fine x :: nil.
  Definition one := AreaDoubleHull.one.
  Definition corner := AreaDoubleHull.corner.
  Definition cross := AreaDoubleHull.cross.
  Definition hull := AreaDoubleHull.filter_hull_area2 1.
  Definition turn := AreaRound.turn.
  Definition turn_error := AreaRound.turn_error.
  Definition star := AreaRound.star.
End Area.
Module Circle.
  Definition feature := Circles.Build_feature.
  Definition parts (k : Circles.centre) : list Z :=
    Circles.a0 k :: Circles.a1 k :: Circles.b0 k :: Circles.b1 k :: Circles.cc k :: Circles.dd k :: nil.
  Definition rational := Circles.rational.
  Definition two_points := Circles.two_points.
  Definition point_beside_line := Circles.point_beside_line.
  Definition point_and_line := Circles.point_and_line.
  Definition parallel_lines := Circles.parallel_lines.
  Definition crossing_lines := Circles.crossing_lines.
  Definition solve := Circles.solve.
End Circle.
Module Pane.
  Definition two_points := FiltersCell.cell_two_points.
  Definition point_and_line := FiltersCell.point_and_line.
  Definition parallel_lines := FiltersCell.parallel_lines.
  Definition crossing_lines := FiltersCell.crossing_lines.
  Definition outside_slab := FiltersCell.outside_slab.
End Pane.

Extraction "filters.ml" fsub b64_of_bits bits_of_b64 is_nan_double box box_ends iv_of iv_ends Plane Fixed Area Circle Pane
  FiltersOrient.orient_bound FiltersOrient.filter_orient FiltersOrient.filter_orient_near
  FiltersIncircleAt.filter_incircle_at FiltersIncircleNear.filter_incircle_near FiltersSmall.filter_incircle_small
  FiltersSmall.filter_orient_small fmax lower upper ds2_lower dl2_upper FiltersSlack.ds2_upper FiltersSlack.dl2_lower
  FiltersDirection.reach FiltersDirection.height_lower FiltersDirectionBox.hull FiltersDirectionBox.direction_d
  FiltersFarther.farther_along FiltersFarther.is_farther FiltersInterval.down FiltersInterval.up FiltersInterval.iv_add
  FiltersInterval.iv_sub FiltersIntervalSign.span4 FiltersIntervalSign.iv_mul FiltersIntervalSign.iv_sign
  FiltersIntervalSign.iv_det2 FiltersIntervalSign.sign_of_boxes FiltersIntervalRoot.iv_div FiltersIntervalRoot.iv_sqrt
  FiltersIntervalRoot.iv_point FiltersIntervalRoot.iv_neg FiltersIntervalRoot.iv_scale FiltersIntervalCircle.iv_sqr
  FiltersIntervalCircle.incircle_of_boxes FiltersExpr.span_add FiltersExpr.span_neg FiltersExpr.corners FiltersExpr.span_mul
  FiltersExpr.span_div FiltersExpr.span_sqrt FiltersExpr.span_abs FiltersExprPower.span_power_signed FiltersGrid.filter_bits
  FiltersGrid.power_of_two FiltersGrid.filter_round FiltersScale.user_upper FiltersScale.user_lower
  FiltersNearCode.square_distance FiltersNearCode.filter_edge_near FiltersNearHull.filter_hull_edge_near FiltersStar.radius
  FiltersStar.others_farther FiltersStar.star_edge FiltersStarWitness.star_hull FiltersFixed.fixed_incircle
  AreaDouble.two_sum AreaDouble.fast_two_sum AreaDouble.dd_sub_d AreaDouble.dd_add AreaDouble.dd_mul AreaDouble.inflate
  AreaDoubleHull.lead_in_range Surd.compare_squares Surd.sqrt_sign Surd.sqrt2_sign CirclesRadius.radius_a
  CirclesRadius.radius_b CirclesRadius.add_square_p CirclesRadius.add_square_q CirclesRadius.within_low
  CirclesRadius.within_high.
