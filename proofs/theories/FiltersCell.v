(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(** [CRIT-1] Throwing out cells in interval arithmetic: what src/predicate/predicate_filter.c encloses are the roots, in each
    of its four cases. *)
From Coq Require Import Bool ZArith Reals Lia Lra Psatz List.
From Flocq Require Import Core Binary.
From Dyadel Require Import FiltersBase FiltersError FiltersConst FiltersDistance FiltersInterval FiltersIntervalSign
  FiltersIntervalCircle FiltersIntervalRoot.
Import ListNotations.
Open Scope R_scope.

(* [CRIT-1] src/predicate/predicate_filter.c: dyd_iv_scale(dyd_iv_add(f->at[k], g->at[k]), {}) *)
Definition c_cell_half : const := (1, -1)%Z.
(* [CRIT-1] src/predicate/predicate_filter.c: dyd_iv det2 = dyd_iv_scale(det, {}); *)
(* [CRIT-1] src/predicate/predicate_filter.c: dyd_iv b2 = dyd_iv_scale(b, {}), *)
(* [CRIT-1] src/predicate/predicate_filter.c: a2 = dyd_iv_scale(a, {}); *)
(* [CRIT-1] src/predicate/predicate_filter.c: dyd_iv_sqrt(dyd_iv_scale(lm, {})) *)
Definition c_cell_two : const := (1, 1)%Z.

Lemma twice_contains a x : contains a x -> contains (iv_scale a (lit c_cell_two)) (2 * x).
Proof.
  intros H. destruct (lit_correct c_cell_two eq_refl) as [_ V]. assert (E : val (lit c_cell_two) = 2) by (rewrite V; unfold
    c_cell_two; numerals; lra).
  replace (2 * x) with (x * val (lit c_cell_two)) by (rewrite E; ring). apply iv_scale_contains; [rewrite E; lra|exact H].
Qed.

(** The quotient of two intervals holds each solution of the linear equation. *)
Lemma iv_div_solves a b x y w : contains a x -> contains b y -> w * y = x -> contains (iv_div a b) w.
Proof.
  intros A B E. destruct (Req_dec y 0) as [Z|Z].
  - unfold iv_div. destruct (gt (lo b) (lit c_zero) || lt (hi b) (lit c_zero)) eqn:S; [|apply unknown_contains]. exfalso.
    destruct B as [[N1 B1] [N2 B2]]. apply orb_true_iff in S. destruct S as [S|S].
    + apply gt_zero in S. destruct S as [[F P]|S]; [specialize (B1 F); lra|contradiction].
    + apply lt_zero in S. destruct S as [[F P]|S]; [specialize (B2 F); lra|contradiction].
  - replace w with (x / y) by (rewrite <- E; field; exact Z). now apply iv_div_contains.
Qed.

Lemma negative_end c x : contains c x -> lt (hi c) (lit c_zero) = true -> x < 0.
Proof.
  intros [_ [N H]] L. apply lt_zero in L. destruct L as [[F P]|L]; [specialize (H F); lra|contradiction].
Qed.

(** Circles through the origin with centre (u,v): through (a,b), or touching the line u = l. *)
Definition through (a b u v : R) : Prop := (u - a) * (u - a) + (v - b) * (v - b) = u * u + v * v.
Definition touches (l u v : R) : Prop := (u - l) * (u - l) = u * u + v * v.

(** The result of the functions below: None if no bound is known, or the centres relative to p are in these boxes. *)
Definition roots : Type := option (list (iv * iv)).
Definition holds_root (found : roots) (u v : R) : Prop :=
  match found with None => True | Some l => exists c, In c l /\ contains (fst c) u /\ contains (snd c) v end.

(* C src/predicate/predicate_filter.c iv_two_points
  dyd_iv s = dyd_iv_add(dyd_iv_sqr(f->at[0]), dyd_iv_sqr(f->at[1]));
  dyd_iv t = dyd_iv_add(dyd_iv_sqr(g->at[0]), dyd_iv_sqr(g->at[1]));
  dyd_iv det = dyd_iv_sub(dyd_iv_mul(f->at[0], g->at[1]), dyd_iv_mul(g->at[0], f->at[1]));
  dyd_iv u = dyd_iv_sub(dyd_iv_mul(s, g->at[1]), dyd_iv_mul(t, f->at[1]));
  dyd_iv v = dyd_iv_sub(dyd_iv_mul(f->at[0], t), dyd_iv_mul(g->at[0], s));
  dyd_iv det2 = dyd_iv_scale(det, 2);
  return (roots){true, 1, {{dyd_iv_div(u, det2), dyd_iv_div(v, det2)}, {{0, 0}, {0, 0}}}};
*)
Definition cell_two_points (f0 f1 g0 g1 : iv) : iv * iv :=
  let s := iv_add (iv_sqr f0) (iv_sqr f1) in let t := iv_add (iv_sqr g0) (iv_sqr g1) in
  let det := iv_sub (iv_mul f0 g1) (iv_mul g0 f1) in
  let u := iv_sub (iv_mul s g1) (iv_mul t f1) in let v := iv_sub (iv_mul f0 t) (iv_mul g0 s) in
  let det2 := iv_scale det (lit c_cell_two) in
  (iv_div u det2, iv_div v det2).
Theorem cell_two_points_encloses f0 f1 g0 g1 a b c d u v : contains f0 a -> contains f1 b -> contains g0 c -> contains g1 d ->
  through a b u v -> through c d u v ->
  contains (fst (cell_two_points f0 f1 g0 g1)) u /\ contains (snd (cell_two_points f0 f1 g0 g1)) v.
Proof.
  unfold through. intros A B C D P Q. cbn [fst snd cell_two_points].
  assert (S : contains (iv_add (iv_sqr f0) (iv_sqr f1)) (a * a + b * b)) by (apply iv_add_contains; now apply iv_sqr_contains).
  assert (T : contains (iv_add (iv_sqr g0) (iv_sqr g1)) (c * c + d * d)) by (apply iv_add_contains; now apply iv_sqr_contains).
  assert (Det : contains (iv_scale (iv_sub (iv_mul f0 g1) (iv_mul g0 f1)) (lit c_cell_two)) (2 * (a * d - c * b)))
    by (apply twice_contains, iv_sub_contains; now apply iv_mul_contains).
  assert (P' : 2 * a * u + 2 * b * v = a * a + b * b) by lra. assert (Q' : 2 * c * u + 2 * d * v = c * c + d * d) by lra.
  split.
  - apply (iv_div_solves _ _ ((a * a + b * b) * d - (c * c + d * d) * b) (2 * (a * d - c * b))); [|exact Det|].
    + apply iv_sub_contains; now apply iv_mul_contains.
    + rewrite <- P', <- Q'. ring.
  - apply (iv_div_solves _ _ (a * (c * c + d * d) - c * (a * a + b * b)) (2 * (a * d - c * b))); [|exact Det|].
    + apply iv_sub_contains; now apply iv_mul_contains.
    + rewrite <- P', <- Q'. ring.
Qed.

(* C src/predicate/predicate_filter.c iv_point_and_line
  int k = line->has[0] ? 0 : 1;
  dyd_iv a = point->at[k], b = point->at[1 - k], l = line->at[k];
  dyd_iv s = dyd_iv_add(dyd_iv_sqr(a), dyd_iv_sqr(b));
  dyd_iv c = dyd_iv_mul(dyd_iv_mul(s, l), dyd_iv_sub(l, a));
  if (c.hi < 0) return no_roots;
  dyd_iv root = dyd_iv_sqrt(c), bl = dyd_iv_mul(b, l);
  dyd_iv b2 = dyd_iv_scale(b, 2), a2 = dyd_iv_scale(a, 2);
  roots found = {true, 2, {{{0, 0}, {0, 0}}, {{0, 0}, {0, 0}}}};
  for (int i = 0; i < 2; i++) {
    dyd_iv v = dyd_iv_div(i ? dyd_iv_sub(bl, root) : dyd_iv_add(bl, root), a);
    found.at[i][1 - k] = v;
    found.at[i][k] = dyd_iv_div(dyd_iv_sub(s, dyd_iv_mul(b2, v)), a2);
  }
  return found;
*)
Definition point_line_c (a b l : iv) : iv := iv_mul (iv_mul (iv_add (iv_sqr a) (iv_sqr b)) l) (iv_sub l a).
Definition cell_point_line (a b l : iv) (second : bool) : iv * iv :=
  let s := iv_add (iv_sqr a) (iv_sqr b) in let root := iv_sqrt (point_line_c a b l) in let bl := iv_mul b l in
  let v := iv_div (if second then iv_sub bl root else iv_add bl root) a in
  (iv_div (iv_sub s (iv_mul (iv_scale b (lit c_cell_two)) v)) (iv_scale a (lit c_cell_two)), v).
Theorem cell_point_line_encloses ia ib il a b l u v : contains ia a -> contains ib b -> contains il l ->
  through a b u v -> touches l u v ->
  lt (hi (point_line_c ia ib il)) (lit c_zero) = false /\
  exists second, contains (fst (cell_point_line ia ib il second)) u /\ contains (snd (cell_point_line ia ib il second)) v.
Proof.
  unfold through, touches. intros A B L P Q.
  assert (S : contains (iv_add (iv_sqr ia) (iv_sqr ib)) (a * a + b * b)) by (apply iv_add_contains; now apply iv_sqr_contains).
  assert (C : contains (point_line_c ia ib il) ((a * a + b * b) * l * (l - a))).
  { unfold point_line_c. apply iv_mul_contains; [now apply iv_mul_contains|now apply iv_sub_contains]. }
  assert (P' : 2 * a * u + 2 * b * v = a * a + b * b) by lra. assert (Q' : v * v + 2 * l * u = l * l) by lra.
  set (w := a * v - b * l).
  assert (W : w * w = (a * a + b * b) * l * (l - a)).
  { unfold w. rewrite <- P'. transitivity (a * a * (v * v + 2 * l * u) - a * l * (2 * a * u + 2 * b * v) + b * b * (l * l));
      [ring|]. rewrite P', Q'. transitivity (l * ((a * a + b * b) * (l - a))); [ring|]. rewrite <- P'. ring. }
  assert (C0 : 0 <= (a * a + b * b) * l * (l - a)) by (rewrite <- W; apply Rle_0_sqr).
  split.
  { destruct (lt (hi (point_line_c ia ib il)) (lit c_zero)) eqn:E; [exfalso|reflexivity].
    pose proof (negative_end _ _ C E). lra. }
  pose proof (iv_sqrt_contains _ _ C C0) as R. rewrite <- W in R. set (r := sqrt (w * w)) in *.
  assert (BL : contains (iv_mul ib il) (b * l)) by now apply iv_mul_contains.
  assert (Abs : r = Rabs w) by (unfold r; apply sqrt_Rsqr_abs).
  assert (V : exists second, contains (snd (cell_point_line ia ib il second)) v).
  { destruct (Rle_or_lt 0 w) as [H|H].
    - exists false. cbn [snd cell_point_line]. apply (iv_div_solves _ _ (b * l + r) a); [now apply iv_add_contains|exact A|].
      rewrite Abs, Rabs_pos_eq by exact H. unfold w. ring.
    - exists true. cbn [snd cell_point_line]. apply (iv_div_solves _ _ (b * l - r) a); [now apply iv_sub_contains|exact A|].
      rewrite Abs, Rabs_left by exact H. unfold w. ring. }
  destruct V as [second V]. exists second. split; [|exact V].
  cbn [fst cell_point_line]. cbn [snd cell_point_line] in V.
  apply (iv_div_solves _ _ (a * a + b * b - 2 * b * v) (2 * a)); [|now apply twice_contains|rewrite <- P'; ring].
  apply iv_sub_contains; [exact S|]. apply iv_mul_contains; [now apply twice_contains|exact V].
Qed.

(** Both roots, the coordinate across the line first. *)
Definition point_and_line (a b l : iv) : roots :=
  if lt (hi (point_line_c a b l)) (lit c_zero) then Some [] else Some [cell_point_line a b l false; cell_point_line a b l true].
Theorem point_and_line_holds ia ib il a b l u v : contains ia a -> contains ib b -> contains il l ->
  through a b u v -> touches l u v -> holds_root (point_and_line ia ib il) u v.
Proof.
  intros A B L P Q. destruct (cell_point_line_encloses _ _ _ _ _ _ _ _ A B L P Q) as (C & second & U & V).
  unfold point_and_line. rewrite C. exists (cell_point_line ia ib il second). split; [|now split].
  destruct second; [right; left|left]; reflexivity.
Qed.

(* C src/predicate/predicate_filter.c iv_parallel_lines
  dyd_iv c = dyd_iv_neg(dyd_iv_mul(f->at[k], g->at[k]));
  if (c.hi < 0) return no_roots;
  dyd_iv u = dyd_iv_scale(dyd_iv_add(f->at[k], g->at[k]), 0.5), v = dyd_iv_sqrt(c);
  roots found = {true, 2, {{{0, 0}, {0, 0}}, {{0, 0}, {0, 0}}}};
  found.at[0][k] = found.at[1][k] = u;
  found.at[0][1 - k] = v;
  found.at[1][1 - k] = dyd_iv_neg(v);
  return found;
*)
Definition parallel_c (l m : iv) : iv := iv_neg (iv_mul l m).
Theorem cell_parallel_encloses il im l m u v : contains il l -> contains im m -> l <> m -> touches l u v -> touches m u v ->
  lt (hi (parallel_c il im)) (lit c_zero) = false /\ contains (iv_scale (iv_add il im) (lit c_cell_half)) u /\
  (contains (iv_sqrt (parallel_c il im)) v \/ contains (iv_neg (iv_sqrt (parallel_c il im))) v).
Proof.
  unfold touches. intros L M D P Q.
  assert (U : u = (l + m) / 2).
  { apply Rmult_eq_reg_l with (l - m); [lra|lra]. }
  assert (V : v * v = - (l * m)) by (rewrite U in P; lra).
  assert (C : contains (parallel_c il im) (- (l * m))) by (apply iv_neg_contains; now apply iv_mul_contains).
  assert (C0 : 0 <= - (l * m)) by (rewrite <- V; apply Rle_0_sqr).
  split.
  { destruct (lt (hi (parallel_c il im)) (lit c_zero)) eqn:E; [exfalso|reflexivity].
    pose proof (negative_end _ _ C E). lra. }
  split.
  - destruct (lit_correct c_cell_half eq_refl) as [_ E].
    assert (E' : val (lit c_cell_half) = / 2) by (rewrite E; unfold c_cell_half; numerals; lra).
    rewrite U. unfold Rdiv. rewrite <- E'. apply iv_scale_contains; [rewrite E'; lra|now apply iv_add_contains].
  - pose proof (iv_sqrt_contains _ _ C C0) as R. rewrite <- V in R.
    change (v * v) with (Rsqr v) in R. rewrite sqrt_Rsqr_abs in R. destruct (Rle_or_lt 0 v) as [H|H].
    + left. now rewrite Rabs_pos_eq in R.
    + right. rewrite Rabs_left in R by exact H. rewrite <- (Ropp_involutive v). now apply iv_neg_contains.
Qed.

(** The coordinate across the lines first. *)
Definition parallel_lines (l m : iv) : roots :=
  if lt (hi (parallel_c l m)) (lit c_zero) then Some []
  else
    let u := iv_scale (iv_add l m) (lit c_cell_half) in let v := iv_sqrt (parallel_c l m) in Some [(u, v); (u, iv_neg v)].
Theorem parallel_lines_hold il im l m u v : contains il l -> contains im m -> l <> m -> touches l u v -> touches m u v ->
  holds_root (parallel_lines il im) u v.
Proof.
  intros L M D P Q. destruct (cell_parallel_encloses _ _ _ _ _ _ L M D P Q) as (C & U & [V|V]); unfold parallel_lines;
    rewrite C; eexists; [split; [left; reflexivity|]|split; [right; left; reflexivity|]]; now split.
Qed.

(* C src/predicate/predicate_filter.c iv_crossing_lines
  dyd_iv lm = dyd_iv_mul(l, m);
  int sign = dyd_iv_sign(lm);
  if (!sign) return unknown_roots;
  if (sign < 0) {
    l = dyd_iv_neg(l);
    m = dyd_iv_neg(m);
    lm = dyd_iv_neg(lm);
  }
  dyd_iv root = dyd_iv_sqrt(dyd_iv_scale(lm, 2));
  dyd_iv plus_u = dyd_iv_sub(root, m), minus_u = dyd_iv_neg(dyd_iv_add(root, m));
  dyd_iv plus_v = dyd_iv_sub(root, l), minus_v = dyd_iv_neg(dyd_iv_add(root, l));
  if (sign > 0) return (roots){true, 2, {{plus_u, plus_v}, {minus_u, minus_v}}};
  return (roots){true, 2, {{plus_u, minus_v}, {minus_u, plus_v}}};
*)
Definition cell_crossing (il im : iv) (second : bool) : iv * iv :=
  let negative := Z.eqb (iv_sign (iv_mul il im)) (-1) in
  let l := if negative then iv_neg il else il in let m := if negative then iv_neg im else im in
  let lm := if negative then iv_neg (iv_mul il im) else iv_mul il im in
  let root := iv_sqrt (iv_scale lm (lit c_cell_two)) in
  let plus_u := iv_sub root m in let minus_u := iv_neg (iv_add root m) in
  let plus_v := iv_sub root l in let minus_v := iv_neg (iv_add root l) in
  (if second then minus_u else plus_u, if Bool.eqb second negative then plus_v else minus_v).
Theorem cell_crossing_encloses il im l m u v : contains il l -> contains im m -> touches l u v -> touches m v u ->
  iv_sign (iv_mul il im) <> 0%Z ->
  exists second, contains (fst (cell_crossing il im second)) u /\ contains (snd (cell_crossing il im second)) v.
Proof.
  unfold touches. intros L M P Q S. pose proof (iv_mul_contains _ _ _ _ L M) as LM.
  destruct (iv_sign_correct _ _ LM) as [Sp Sn].
  assert (main : forall l m u v, 0 < l * m -> v * v + 2 * l * u = l * l -> u * u + 2 * m * v = m * m ->
    forall ilm, contains ilm (l * m) -> exists r, contains (iv_sqrt (iv_scale ilm (lit c_cell_two))) r /\
    ((u = r - m /\ v = r - l) \/ (u = - (r + m) /\ v = - (r + l)))).
  { clear. intros l m u v LM P Q ilm C. exists (Rabs (u + m)).
    assert (PQ : (u - l - (v - m)) * (u - l + (v - m)) = 0) by lra.
    assert (E : v = u - l + m).
    { apply Rmult_integral in PQ. destruct PQ as [H|H]; [lra|exfalso]. assert (V : v = m + l - u) by lra. subst v.
      assert ((u - m) * (u - m) = - (2 * (l * m))) by lra. pose proof (Rle_0_sqr (u - m)). unfold Rsqr in *. lra. }
    assert (W : Rsqr (u + m) = 2 * (l * m)) by (unfold Rsqr; subst v; lra).
    pose proof (iv_sqrt_contains _ _ (twice_contains _ _ C) ltac:(lra)) as R. rewrite <- W, sqrt_Rsqr_abs in R.
    split; [exact R|]. destruct (Rle_or_lt 0 (u + m)) as [H|H]; [left; rewrite Rabs_pos_eq by exact H|right; rewrite
      Rabs_left by exact H]; lra. }
  unfold cell_crossing. assert (T : iv_sign (iv_mul il im) = 1%Z \/ iv_sign (iv_mul il im) = (-1)%Z).
  { revert S. unfold iv_sign. destruct (gt _ _); [now left|]. destruct (lt _ _); [now right|]. intros S. now contradiction S. }
  destruct T as [T|T]; rewrite T; cbn [Z.eqb Pos.eqb]; cbv zeta.
  - destruct (main l m u v (Sp T) ltac:(lra) ltac:(lra) _ LM) as (r & R & [[-> ->]|[-> ->]]); [exists false|exists true];
      cbn [fst snd Bool.eqb]; split; try (now apply iv_sub_contains); now apply iv_neg_contains, iv_add_contains.
  - specialize (Sn T). pose proof (iv_neg_contains _ _ LM) as LM'.
    replace (- (l * m)) with (l * - m) in LM' by ring.
    destruct (main l (- m) u (- v) ltac:(lra) ltac:(lra) ltac:(lra) _ LM') as (r & R & [[U V]|[U V]]);
      [exists false|exists true]; cbn [fst snd Bool.eqb]; split.
    + rewrite U. now apply iv_sub_contains, iv_neg_contains.
    + replace v with (- (r + - l)) by lra. now apply iv_neg_contains, iv_add_contains, iv_neg_contains.
    + rewrite U. now apply iv_neg_contains, iv_add_contains, iv_neg_contains.
    + replace v with (r - - l) by lra. now apply iv_sub_contains, iv_neg_contains.
Qed.

Definition crossing_lines (l m : iv) : roots :=
  if (iv_sign (iv_mul l m) =? 0)%Z then None else Some [cell_crossing l m false; cell_crossing l m true].
Theorem crossing_lines_hold il im l m u v : contains il l -> contains im m -> touches l u v -> touches m v u ->
  holds_root (crossing_lines il im) u v.
Proof.
  intros L M P Q. unfold crossing_lines. destruct (_ =? _)%Z eqn:S; [exact I|]. apply Z.eqb_neq in S.
  destruct (cell_crossing_encloses _ _ _ _ _ _ L M P Q S) as (second & U & V). exists (cell_crossing il im second).
  split; [|now split]. destruct second; [right; left|left]; reflexivity.
Qed.

(* C src/predicate/predicate_filter.c outside_slab
  dyd_iv at = dyd_iv_add(t, p);
  return (s->lo2 && at.hi < s->lo.lo) || (s->hi2 && at.lo > s->hi.hi);
*)
(** A centre at p + t is not between bounds that are enclosed by lower and upper. *)
Theorem outside_correct t p lower upper x o low high : contains t x -> contains p o -> contains lower low ->
  contains upper high ->
  (lt (hi (iv_add t p)) (lo lower) = true -> x + o < low) /\ (gt (lo (iv_add t p)) (hi upper) = true -> high < x + o).
Proof.
  intros T P [L _] [_ H]. destruct (iv_add_contains _ _ _ _ T P) as [[A1 A2] [B1 B2]]. destruct L as [N L]. destruct H as [M
    H].
  set (a := lo (iv_add t p)) in *. set (b := hi (iv_add t p)) in *. split; intros G.
  - destruct (cases b) as [F|[F|[F|F]]]; [|destruct b; try discriminate; destruct (lo lower); discriminate| |contradiction].
    + destruct (cases (lo lower)) as [K|[K|[K|K]]]; [|exfalso; destruct (lo lower); try discriminate; destruct b;
        discriminate|contradiction|].
      * apply lt_finite in G; [|assumption..]. specialize (B2 F). specialize (L K). lra.
      * rewrite K in G. destruct b; discriminate.
    + rewrite F in G. destruct (lo lower) as [|[|]| |]; discriminate.
  - destruct (cases a) as [F|[F|[F|F]]]; [|destruct a; try discriminate; destruct (hi upper); discriminate|contradiction|].
    + destruct (cases (hi upper)) as [K|[K|[K|K]]]; [|exfalso; destruct (hi upper); try discriminate; destruct a;
        discriminate| |contradiction].
      * apply gt_finite in G; [|assumption..]. specialize (A2 F). specialize (H K). lra.
      * rewrite K in G. destruct a; discriminate.
    + rewrite F in G. destruct (hi upper) as [|[|]| |]; discriminate.
Qed.

(** Only bounds that exist count. *)
Definition outside_slab (t p lower upper : iv) (has_lower has_upper : bool) : bool :=
  let place := iv_add t p in (has_lower && lt (hi place) (lo lower)) || (has_upper && gt (lo place) (hi upper)).
Theorem outside_slab_correct t p lower upper x o low high has_lower has_upper : contains t x -> contains p o ->
  contains lower low -> contains upper high -> outside_slab t p lower upper has_lower has_upper = true ->
  (has_lower = true /\ x + o < low) \/ (has_upper = true /\ high < x + o).
Proof.
  intros T P L H S. destruct (outside_correct _ _ _ _ _ _ _ _ T P L H) as [B A]. unfold outside_slab in S.
  apply orb_prop in S. destruct S as [S|S]; apply andb_prop in S; destruct S as [S0 S1]; [left|right]; now auto.
Qed.
