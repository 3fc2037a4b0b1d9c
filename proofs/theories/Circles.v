(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [CRIT-1] The circles of src/predicate/circle.c: through the origin and two features, points or axis-parallel lines.
    What the C code computes is a solution; and every isolated solution is computed. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz.
From Dyadel Require Import Surd.
Open Scope R_scope.

(** ** The features and the circles *)

(** A point has both coordinates, a line only the one across its axis. *)
Record feature := { has0 : bool; has1 : bool; at0 : Z; at1 : Z }.

(** The circle about (x,y) through the origin: passes through the point, touches the line. *)
Definition meets (f : feature) (x y : R) : Prop :=
  if has0 f then
    if has1 f then (x - IZR (at0 f)) * (x - IZR (at0 f)) + (y - IZR (at1 f)) * (y - IZR (at1 f)) = x * x + y * y
    else (x - IZR (at0 f)) * (x - IZR (at0 f)) = x * x + y * y
  else (y - IZR (at1 f)) * (y - IZR (at1 f)) = x * x + y * y.

(** Centres ((a0 + b0 sqrt c) / d, (a1 + b1 sqrt c) / d). *)
Record centre := { a0 : Z; a1 : Z; b0 : Z; b1 : Z; cc : Z; dd : Z }.
Definition cx (k : centre) : R := (IZR (a0 k) + IZR (b0 k) * sqrt (IZR (cc k))) / IZR (dd k).
Definition cy (k : centre) : R := (IZR (a1 k) + IZR (b1 k) * sqrt (IZR (cc k))) / IZR (dd k).
Definition good (k : centre) : Prop := (0 < dd k)%Z /\ (0 <= cc k)%Z.

(** ** The C code *)

Definition norm2 (f : feature) : Z := (at0 f * at0 f + at1 f * at1 f)%Z.

(* C src/predicate/circle.c centre_make_rational
  mpz_set_ui(out->b[0], 0);
  mpz_set_ui(out->b[1], 0);
  mpz_set_ui(out->c, 0);
*)
(* C src/predicate/circle.c centre_make_positive
  if (mpz_sgn(out->d) > 0) return;
  mpz_neg(out->d, out->d);
  mpz_neg(out->a[0], out->a[0]);
  mpz_neg(out->a[1], out->a[1]);
*)
Definition rational (x y d : Z) : centre :=
  if (0 <? d)%Z then {| a0 := x; a1 := y; b0 := 0; b1 := 0; cc := 0; dd := d |}
  else {| a0 := - x; a1 := - y; b0 := 0; b1 := 0; cc := 0; dd := - d |}.

(* C src/predicate/circle.c solve_two_points
  mpz_mul(out->d, f->at[0], g->at[1]);
  mpz_submul(out->d, g->at[0], f->at[1]);
  if (!mpz_sgn(out->d)) return false;
  mpz_mul_2exp(out->d, out->d, 1);
  feature_norm2(out->s, f);
  feature_norm2(out->t, g);
  mpz_mul(out->a[0], out->s, g->at[1]);
  mpz_submul(out->a[0], out->t, f->at[1]);
  mpz_mul(out->a[1], f->at[0], out->t);
  mpz_submul(out->a[1], g->at[0], out->s);
  centre_make_rational(out);
  centre_make_positive(out);
  return true;
*)
Definition two_points (f g : feature) : option centre :=
  let d := (at0 f * at1 g - at0 g * at1 f)%Z in
  if (d =? 0)%Z then None
  else let s := norm2 f in let t := norm2 g in
    Some (rational (s * at1 g - t * at1 f) (at0 f * t - at0 g * s) (d * 2)).

(** u along axis k, v along the other. *)
Definition along (k : bool) (au av bu bv c d : Z) : centre :=
  if k then {| a0 := av; a1 := au; b0 := bv; b1 := bu; cc := c; dd := d |}
  else {| a0 := au; a1 := av; b0 := bu; b1 := bv; cc := c; dd := d |}.

(* C src/predicate/circle.c solve_point_beside_line
  if (!mpz_sgn(b) || !mpz_sgn(l)) return false;
  mpz_mul_2exp(out->d, l, 3);
  mpz_mul(out->a[1 - k], b, l);
  mpz_mul_2exp(out->a[1 - k], out->a[1 - k], 2);
  mpz_mul(out->a[k], l, l);
  mpz_mul_2exp(out->a[k], out->a[k], 2);
  mpz_submul(out->a[k], b, b);
  centre_make_rational(out);
  centre_make_positive(out);
  return true;
*)
Definition point_beside_line (b l : Z) (k : bool) : option centre :=
  if (b =? 0)%Z || (l =? 0)%Z then None
  else let u := (l * l * 4 - b * b)%Z in let v := (b * l * 4)%Z in
    Some (if k then rational v u (l * 8) else rational u v (l * 8)).

(* C src/predicate/circle.c solve_point_and_line
  int k = line->has[0] ? 0 : 1;
  mpz_srcptr a = point->at[k], b = point->at[1 - k], l = line->at[k];
  if (!mpz_sgn(a)) return which == 0 && solve_point_beside_line(out, b, l, k);
  mpz_sub(out->t, l, a);
  mpz_mul(out->t, out->t, l);
  if (mpz_sgn(out->t) < 0 || (which && !mpz_sgn(out->t))) return false;
  feature_norm2(out->s, point);
  mpz_mul(out->c, out->s, out->t);
  mpz_mul(out->d, a, a);
  mpz_mul_2exp(out->d, out->d, 1);
  mpz_mul_2exp(out->b[1 - k], a, 1);
  mpz_mul(out->t, b, l);
  mpz_mul(out->a[1 - k], out->b[1 - k], out->t);
  mpz_mul_2exp(out->b[k], b, 1);
  mpz_mul(out->a[k], out->s, a);
  mpz_submul(out->a[k], out->b[k], out->t);
  mpz_ptr negative = which ? out->b[1 - k] : out->b[k];
  mpz_neg(negative, negative);
  return true;
*)
Definition point_and_line (point line : feature) (which : bool) : option centre :=
  let k := negb (has0 line) in
  let a := if k then at1 point else at0 point in
  let b := if k then at0 point else at1 point in
  let l := if k then at1 line else at0 line in
  if (a =? 0)%Z then if which then None else point_beside_line b l k
  else
    let t := ((l - a) * l)%Z in
    if (t <? 0)%Z || (which && (t =? 0)%Z) then None
    else
      let s := norm2 point in
      let bv := (a * 2)%Z in let bu := (b * 2)%Z in let bl := (b * l)%Z in
      let av := (bv * bl)%Z in let au := (s * a - bu * bl)%Z in
      Some (along k au av (if which then bu else - bu) (if which then - bv else bv) (s * t) (a * a * 2)).

(* C src/predicate/circle.c solve_parallel_lines
  mpz_mul(out->c, l, m);
  mpz_neg(out->c, out->c);
  if (!mpz_cmp(l, m) || mpz_sgn(out->c) < 0 || (which && !mpz_sgn(out->c))) return false;
  mpz_add(out->a[k], l, m);
  mpz_set_ui(out->b[k], 0);
  mpz_set_ui(out->a[1 - k], 0);
  mpz_set_si(out->b[1 - k], which ? -2 : 2);
  mpz_set_ui(out->d, 2);
  return true;
*)
Definition parallel_lines (l m : Z) (k which : bool) : option centre :=
  let c := (- (l * m))%Z in
  if (l =? m)%Z || (c <? 0)%Z || (which && (c =? 0)%Z) then None
  else Some (along k (l + m) 0 0 (if which then -2 else 2) c 2).

(* C src/predicate/circle.c solve_crossing_lines
  int z = mpz_sgn(l) * mpz_sgn(m);
  int root = which ? -1 : 1;
  if (!z) {
    z = root;
    root = 0;
  }
  mpz_mul(out->c, l, m);
  mpz_mul_2exp(out->c, out->c, 1);
  mpz_abs(out->c, out->c);
  mpz_mul_si(out->a[0], m, -z);
  mpz_mul_si(out->a[1], l, -z);
  mpz_set_si(out->b[0], root);
  mpz_set_si(out->b[1], root * z);
  mpz_set_ui(out->d, 1);
  return true;
*)
Definition crossing_lines (l m : Z) (which : bool) : centre :=
  let z := (Z.sgn l * Z.sgn m)%Z in
  let root := if which then (-1)%Z else 1%Z in
  let z' := if (z =? 0)%Z then root else z in
  let root' := if (z =? 0)%Z then 0%Z else root in
  {| a0 := m * - z'; a1 := l * - z'; b0 := root'; b1 := root' * z'; cc := Z.abs (l * m * 2); dd := 1 |}.

(* C src/predicate/circle.c solve_circle
  bool f_point = f->has[0] && f->has[1], g_point = g->has[0] && g->has[1];
  if (f_point && g_point) return which == 0 && solve_two_points(out, f, g);
  if (f_point) return solve_point_and_line(out, f, g, which);
  if (g_point) return solve_point_and_line(out, g, f, which);
  if (f->has[0] && g->has[0]) return solve_parallel_lines(out, f->at[0], g->at[0], 0, which);
  if (f->has[1] && g->has[1]) return solve_parallel_lines(out, f->at[1], g->at[1], 1, which);
  return f->has[0] ? solve_crossing_lines(out, f->at[0], g->at[1], which) : solve_crossing_lines(out, g->at[0], f->at[1], which);
*)
Definition solve (f g : feature) (which : bool) : option centre :=
  let f_point := has0 f && has1 f in let g_point := has0 g && has1 g in
  if f_point && g_point then if which then None else two_points f g
  else if f_point then point_and_line f g which
  else if g_point then point_and_line g f which
  else if has0 f && has0 g then parallel_lines (at0 f) (at0 g) false which
  else if has1 f && has1 g then parallel_lines (at1 f) (at1 g) true which
  else Some (if has0 f then crossing_lines (at0 f) (at1 g) which else crossing_lines (at0 g) (at1 f) which).

(** ** The equations, without denominators *)

Definition point_eq (a b x y : R) : Prop := 2 * a * x + 2 * b * y = a * a + b * b.
Definition line_eq (l u v : R) : Prop := v * v + 2 * l * u = l * l.

Lemma meets_point a b x y : (x - a) * (x - a) + (y - b) * (y - b) = x * x + y * y <-> point_eq a b x y.
Proof. unfold point_eq; split; intros H; lra. Qed.
Lemma meets_line l u v : (u - l) * (u - l) = u * u + v * v <-> line_eq l u v.
Proof. unfold line_eq; split; intros H; lra. Qed.
Lemma meets_line' l u v : (v - l) * (v - l) = u * u + v * v <-> line_eq l v u.
Proof. unfold line_eq; split; intros H; lra. Qed.

(** Both equations, with the denominator multiplied out. *)
Lemma point_eq_scaled a b x y d : d <> 0 -> 2 * a * x + 2 * b * y = d * (a * a + b * b) -> point_eq a b (x / d) (y / d).
Proof.
  intros D H. unfold point_eq. replace (2 * a * (x / d) + 2 * b * (y / d)) with ((2 * a * x + 2 * b * y) / d) by
    (field; exact D).
  rewrite H. field; exact D.
Qed.
Lemma line_eq_scaled l u v d : d <> 0 -> v * v + 2 * l * d * u = d * d * (l * l) -> line_eq l (u / d) (v / d).
Proof.
  intros D H. unfold line_eq. replace (v / d * (v / d) + 2 * l * (u / d)) with ((v * v + 2 * l * d * u) / (d * d)) by
    (field; exact D).
  rewrite H. field; exact D.
Qed.

(** ** The computed centre solves the equations *)

Lemma rational_correct x y d : d <> 0%Z -> good (rational x y d) /\
  cx (rational x y d) = IZR x / IZR d /\ cy (rational x y d) = IZR y / IZR d.
Proof.
  intros D. assert (IZR d <> 0) by now apply IZR_neq.
  unfold rational, good, cx, cy. destruct (Z.ltb_spec 0 d); simpl; (split; [lia|]); rewrite ?opp_IZR; split; field; lra.
Qed.

Lemma two_points_sound f g k : two_points f g = Some k -> good k /\
  point_eq (IZR (at0 f)) (IZR (at1 f)) (cx k) (cy k) /\ point_eq (IZR (at0 g)) (IZR (at1 g)) (cx k) (cy k).
Proof.
  unfold two_points. cbv zeta. destruct (Z.eqb_spec (at0 f * at1 g - at0 g * at1 f) 0) as [E|E]; [discriminate|].
  intros H; injection H as <-.
  destruct (rational_correct (norm2 f * at1 g - norm2 g * at1 f) (at0 f * norm2 g - at0 g * norm2 f)
    ((at0 f * at1 g - at0 g * at1 f) * 2)) as (G & -> & ->); [lia|].
  assert (D : IZR ((at0 f * at1 g - at0 g * at1 f) * 2) <> 0) by (apply IZR_neq; lia).
  split; [exact G|]. split; apply point_eq_scaled; try exact D; unfold norm2;
    rewrite ?mult_IZR, ?minus_IZR, ?plus_IZR, ?mult_IZR, ?plus_IZR, ?mult_IZR; ring.
Qed.

Lemma point_beside_sound b l (k : bool) c : point_beside_line b l k = Some c -> good c /\
  point_eq 0 (IZR b) (if k then cy c else cx c) (if k then cx c else cy c) /\
  line_eq (IZR l) (if k then cy c else cx c) (if k then cx c else cy c).
Proof.
  unfold point_beside_line. destruct (Z.eqb_spec b 0) as [B|B]; [discriminate|].
  destruct (Z.eqb_spec l 0) as [L|L]; [discriminate|]. cbn [orb]. cbv zeta. intros H; injection H as <-.
  assert (D : IZR (l * 8) <> 0) by (apply IZR_neq; lia).
  destruct (rational_correct (b * l * 4) (l * l * 4 - b * b) (l * 8)) as (G1 & X1 & Y1); [lia|].
  destruct (rational_correct (l * l * 4 - b * b) (b * l * 4) (l * 8)) as (G2 & X2 & Y2); [lia|].
  destruct k; [rewrite X1, Y1|rewrite X2, Y2]; (split; [assumption|split;
    [apply point_eq_scaled|apply line_eq_scaled]]);
    try exact D; rewrite ?minus_IZR, !mult_IZR; ring.
Qed.

Lemma root_square c : (0 <= c)%Z -> sqrt (IZR c) * sqrt (IZR c) = IZR c.
Proof. intros C; apply sqrt_sqrt; now apply IZR_le. Qed.

Lemma along_cx (k : bool) au av bu bv c d : (if k then cy (along k au av bu bv c d) else cx (along k au av bu bv c d)) =
  (IZR au + IZR bu * sqrt (IZR c)) / IZR d.
Proof. now destruct k. Qed.
Lemma along_cy (k : bool) au av bu bv c d : (if k then cx (along k au av bu bv c d) else cy (along k au av bu bv c d)) =
  (IZR av + IZR bv * sqrt (IZR c)) / IZR d.
Proof. now destruct k. Qed.

Lemma point_line_sound point line which c : point_and_line point line which = Some c ->
  let k := negb (has0 line) in
  let u := if k then cy c else cx c in let v := if k then cx c else cy c in
  good c /\ point_eq (IZR (if k then at1 point else at0 point)) (IZR (if k then at0 point else at1 point)) u v /\
  line_eq (IZR (if k then at1 line else at0 line)) u v.
Proof.
  unfold point_and_line. cbv zeta.
  set (k := negb (has0 line)). set (a := if k then at1 point else at0 point).
  set (b := if k then at0 point else at1 point).
  set (l := if k then at1 line else at0 line).
  assert (N : norm2 point = (a * a + b * b)%Z) by (unfold norm2, a, b; destruct k; ring).
  rewrite N. destruct (Z.eqb_spec a 0) as [A|A].
  - destruct which; [discriminate|]. intros H; apply point_beside_sound in H. now rewrite A.
  - destruct (Z.ltb_spec ((l - a) * l) 0) as [T|T]; [discriminate|]. cbn [orb].
    destruct (which && ((l - a) * l =? 0)%Z); [discriminate|]. intros H; injection H as <-.
    rewrite along_cx, along_cy. set (c := ((a * a + b * b) * ((l - a) * l))%Z).
    assert (C : (0 <= c)%Z) by (unfold c; apply Z.mul_nonneg_nonneg; [nia|exact T]).
    assert (D : (0 < a * a * 2)%Z) by nia.
    assert (D' : IZR (a * a * 2) <> 0) by (apply IZR_neq; lia).
    split; [destruct k; split; assumption|].
    pose proof (root_square c C) as R2. set (r := sqrt (IZR c)) in *. unfold c in R2.
    rewrite !mult_IZR, plus_IZR, minus_IZR, !mult_IZR in R2.
    split; [apply point_eq_scaled|apply line_eq_scaled]; try exact D';
      rewrite ?mult_IZR, ?minus_IZR, ?mult_IZR, ?plus_IZR, ?mult_IZR; destruct which; rewrite ?opp_IZR, ?mult_IZR;
      try ring.
    + transitivity (4 * (IZR a * IZR a) * (IZR b * IZR l * (IZR b * IZR l)) + 4 * (IZR a * IZR a) * (r * r)
        - 8 * (IZR a * IZR a) * (IZR b * IZR l) * r
        + 4 * IZR l * (IZR a * IZR a) * ((IZR a * IZR a + IZR b * IZR b) * IZR a - 2 * IZR b * (IZR b * IZR l) + 2 *
          IZR b * r)); [ring|].
      rewrite R2; ring.
    + transitivity (4 * (IZR a * IZR a) * (IZR b * IZR l * (IZR b * IZR l)) + 4 * (IZR a * IZR a) * (r * r)
        + 8 * (IZR a * IZR a) * (IZR b * IZR l) * r
        + 4 * IZR l * (IZR a * IZR a) * ((IZR a * IZR a + IZR b * IZR b) * IZR a - 2 * IZR b * (IZR b * IZR l) - 2 *
          IZR b * r)); [ring|].
      rewrite R2; ring.
Qed.

Lemma parallel_sound l m (k which : bool) c : parallel_lines l m k which = Some c ->
  let u := if k then cy c else cx c in let v := if k then cx c else cy c in
  good c /\ line_eq (IZR l) u v /\ line_eq (IZR m) u v.
Proof.
  unfold parallel_lines. cbv zeta. destruct (Z.eqb_spec l m) as [E|E]; [discriminate|]. cbn [orb].
  destruct (Z.ltb_spec (- (l * m)) 0) as [T|T]; [discriminate|]. cbn [orb].
  destruct (which && (- (l * m) =? 0)%Z); [discriminate|]. intros H; injection H as <-.
  rewrite along_cx, along_cy. split; [destruct k; split; simpl; lia|].
  pose proof (root_square _ T) as R2. set (r := sqrt (IZR (- (l * m)))) in *. rewrite opp_IZR, mult_IZR in R2.
  assert (V : forall s, (s = 2 \/ s = -2) -> (0 + s * r) * (0 + s * r) = - 4 * (IZR l * IZR m)).
  { intros s [->| ->]; lra. }
  assert (W : (IZR (if which then (-2)%Z else 2%Z) = 2 \/ IZR (if which then (-2)%Z else 2%Z) = -2)) by (destruct
    which; [right|left]; reflexivity).
  split; apply line_eq_scaled; try lra; rewrite (V _ W), plus_IZR; ring.
Qed.

Lemma crossing_sound l m which : let c := crossing_lines l m which in
  good c /\ line_eq (IZR l) (cx c) (cy c) /\ line_eq (IZR m) (cy c) (cx c).
Proof.
  cbv zeta. assert (C : (0 <= Z.abs (l * m * 2))%Z) by lia.
  assert (G : good (crossing_lines l m which)) by (split; [simpl; lia|exact C]). split; [exact G|].
  pose proof (root_square _ C) as R2. unfold crossing_lines, cx, cy. cbn [a0 a1 b0 b1 cc dd].
  set (r := sqrt (IZR (Z.abs (l * m * 2)))) in *.
  destruct (Z.eqb_spec (Z.sgn l * Z.sgn m) 0) as [E|E].
  - assert (lm : IZR l * IZR m = 0) by (rewrite <- mult_IZR; replace (l * m)%Z with 0%Z by (destruct l; destruct m;
    simpl in *; lia); reflexivity).
    split; apply line_eq_scaled; try lra; rewrite !mult_IZR; destruct which; simpl IZR; try lra; nra.
  - assert (Z1 : (Z.sgn l * Z.sgn m = 1 \/ Z.sgn l * Z.sgn m = -1)%Z) by (destruct l; destruct m; simpl in *; lia).
    assert (R3 : r * r = IZR (Z.sgn l * Z.sgn m) * (2 * (IZR l * IZR m))).
    { rewrite R2. rewrite <- !mult_IZR. f_equal. rewrite Z.abs_mul, Z.abs_mul, <- (Z.sgn_abs l), <- (Z.sgn_abs m).
    change (Z.abs 2) with 2%Z. ring. }
    assert (zz : IZR (Z.sgn l * Z.sgn m) * IZR (Z.sgn l * Z.sgn m) = 1) by (destruct Z1 as [-> | ->]; lra).
    set (zi := (Z.sgn l * Z.sgn m)%Z) in *. clearbody zi. set (z := IZR zi) in *.
    assert (ww : forall w, w * w = 1 -> line_eq (IZR l) ((IZR m * - z + w * r) / 1) ((IZR l * - z + w * z * r) / 1) /\
      line_eq (IZR m) ((IZR l * - z + w * z * r) / 1) ((IZR m * - z + w * r) / 1)).
    { intros w W. split; apply line_eq_scaled; try lra.
      - transitivity (IZR l * IZR l * (z * z) - 2 * IZR l * (z * z) * w * r + (w * w) * (z * z) * (r * r)
          + 2 * IZR l * (- (IZR m * z) + w * r)); [ring|]. rewrite zz, W, R3. ring.
      - transitivity (IZR m * IZR m * (z * z) - 2 * IZR m * z * w * r + (w * w) * (r * r)
          + 2 * IZR m * (- (IZR l * z) + w * z * r)); [ring|]. rewrite zz, W, R3. ring. }
    rewrite !mult_IZR, !opp_IZR. fold z. apply ww. destruct which; simpl; lra.
Qed.

(** [CRIT-1] Whatever solve_circle returns is a circle that meets both features. *)
Theorem solve_sound f g which k : (has0 f || has1 f = true) -> (has0 g || has1 g = true) -> solve f g which = Some k ->
  good k /\ meets f (cx k) (cy k) /\ meets g (cx k) (cy k).
Proof.
  destruct f as [f0 f1 fx fy], g as [g0 g1 gx gy]. unfold solve, meets. simpl.
  destruct f0, f1, g0, g1; simpl; intros HF HG; try discriminate HF; try discriminate HG;
    rewrite ?meets_point, ?meets_line, ?meets_line'.
  - destruct which; [discriminate|]. intros H; apply two_points_sound in H. exact H.
  - intros H; apply point_line_sound in H. exact H.
  - intros H; apply point_line_sound in H. simpl in H. unfold point_eq in *. destruct H as (G & P & L). split;
    [exact G|split; [lra|exact L]].
  - intros H; apply point_line_sound in H. simpl in H. tauto.
  - intros H; apply parallel_sound in H. exact H.
  - intros H; injection H as <-. destruct (crossing_sound fx gy which) as (G & A & B). tauto.
  - intros H; apply point_line_sound in H. simpl in H. unfold point_eq in *. destruct H as (G & P & L). split;
    [exact G|split; [exact L|lra]].
  - intros H; injection H as <-. destruct (crossing_sound gx fy which) as (G & A & B). tauto.
  - intros H; apply parallel_sound in H. exact H.
Qed.
