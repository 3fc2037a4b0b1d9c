(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A triangle holds its area: half of the cross product of two sides. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Dyadel Require Import Plane Distance Orientation Measure.
Import ListNotations.
Open Scope R_scope.

(* The open triangle abc; empty unless a, b, c turn left. *)
Definition triangle (a b c z : point) : Prop := 0 < orient a b z /\ 0 < orient b c z /\ 0 < orient c a z.

(* A point between a lower and an upper line, with s < x < t. *)
Section Lines.
Variables p q r w : R.
Let f x := p + q * x.
Let g x := r + w * x.
Let slab s t (z : point) : Prop := s < fst z < t /\ f (fst z) < snd z < g (fst z).

Lemma affine_between k l s t x : s <= x <= t ->
  Rmin (k + l * s) (k + l * t) <= k + l * x <= Rmax (k + l * s) (k + l * t).
Proof.
  intros H. pose proof (Rmin_l (k + l * s) (k + l * t)). pose proof (Rmin_r (k + l * s) (k + l * t)).
  pose proof (Rmax_l (k + l * s) (k + l * t)). pose proof (Rmax_r (k + l * s) (k + l * t)).
  destruct (Rle_dec 0 l); nra.
Qed.

Lemma affine_spread k l s t : s <= t ->
  Rmax (k + l * s) (k + l * t) <= (k + l * s + (k + l * t)) / 2 + Rabs l * (t - s) / 2 /\
  (k + l * s + (k + l * t)) / 2 - Rabs l * (t - s) / 2 <= Rmin (k + l * s) (k + l * t).
Proof.
  intros H. assert (A : Rabs l * (t - s) = Rabs (l * (t - s))) by (rewrite Rabs_mult, (Rabs_pos_eq (t - s)); lra).
  rewrite A. assert (E : k + l * t = k + l * s + l * (t - s)) by ring. rewrite E.
  unfold Rmax, Rmin, Rabs. destruct (Rle_dec _ _), (Rcase_abs _); lra.
Qed.

(* Thin rectangles, by halving: the part that they miss falls by half each time. *)
Lemma slab_inner n : forall s t, s <= t -> f s <= g s -> f t <= g t ->
  exists L, Forall (within (slab s t)) L /\ ForallOrdPairs apart L /\
    (t - s) * (g s - f s + (g t - f t)) / 2 - (Rabs q + Rabs w) * ((t - s) * (t - s)) / 2 ^ n <= areas L.
Proof.
  induction n as [| n IH]; intros s t H Ds Dt.
  - destruct (affine_spread p q s t H) as [F _]. destruct (affine_spread r w s t H) as [_ G].
    fold (f s) (f t) in F. fold (g s) (g t) in G.
    set (lo := Rmax (f s) (f t)) in *. set (hi := Rmin (g s) (g t)) in *.
    pose proof (Rabs_pos q). pose proof (Rabs_pos w).
    destruct (Rle_dec lo hi) as [O | O].
    + exists [Rect s t lo hi H O]. split; [| split].
      * constructor; [| constructor]. intros z [X Y]. simpl in X, Y. split; [exact X |].
        assert (X' : s <= fst z <= t) by lra. pose proof (affine_between p q s t _ X') as B.
        pose proof (affine_between r w s t _ X') as C. fold (f s) (f t) (f (fst z)) in B.
        fold (g s) (g t) (g (fst z)) in C. unfold lo, hi in Y. lra.
      * constructor; constructor.
      * unfold areas, area. simpl. assert ((t - s) * (hi - lo) >=
          (t - s) * ((g s - f s + (g t - f t)) / 2 - (Rabs q + Rabs w) * (t - s) / 2)) by (apply Rmult_ge_compat_l; lra).
        assert (0 <= (t - s) * ((Rabs q + Rabs w) * (t - s))) by (repeat apply Rmult_le_pos; lra). lra.
    + exists []. split; [constructor |]. split; [constructor |]. simpl.
      assert ((t - s) * ((g s - f s + (g t - f t)) / 2 - (Rabs q + Rabs w) * (t - s) / 2) <= (t - s) * 0)
        by (apply Rmult_le_compat_l; lra).
      assert (0 <= (t - s) * ((Rabs q + Rabs w) * (t - s))) by (repeat apply Rmult_le_pos; lra). lra.
  - set (m := (s + t) / 2). assert (M : s <= m <= t) by (unfold m; lra).
    assert (Dm : g m - f m = (g s - f s + (g t - f t)) / 2) by (unfold f, g, m; field).
    destruct (IH s m) as [K [WK [DK SK]]]; try lra. destruct (IH m t) as [L [WL [DL SL]]]; try lra.
    exists (K ++ L). split; [| split].
    + apply Forall_app. split; [revert WK | revert WL]; apply within_subset; unfold slab; intros; lra.
    + apply pairs_app; [exact DK | exact DL |]. apply (apart_of_disjoint (slab s m) (slab m t)); try assumption.
      unfold slab. intros; lra.
    + rewrite areas_app. assert (P : 0 < 2 ^ n) by (apply pow_lt; lra). rewrite Dm in SK, SL.
      assert (E : (Rabs q + Rabs w) * ((t - s) * (t - s)) / 2 ^ S n =
        (Rabs q + Rabs w) * ((m - s) * (m - s)) / 2 ^ n + (Rabs q + Rabs w) * ((t - m) * (t - m)) / 2 ^ n).
      { unfold m. simpl. field. lra. }
      assert (E' : (t - s) * (g s - f s + (g t - f t)) / 2 = (m - s) * (g s - f s + (g s - f s + (g t - f t)) / 2) / 2
        + (t - m) * ((g s - f s + (g t - f t)) / 2 + (g t - f t)) / 2) by (unfold m; field).
      lra.
Qed.

Lemma small_power c e : 0 < e -> exists n, c / 2 ^ n <= e.
Proof.
  intros E. destruct (Rle_dec c 0) as [N | N].
  - exists 0%nat. simpl. lra.
  - destruct (Pow_x_infinity 2) with (b := c / e) as [n H]; [rewrite Rabs_pos_eq; lra |].
    exists n. specialize (H n (le_n n)). assert (P : 0 < 2 ^ n) by (apply pow_lt; lra).
    rewrite Rabs_pos_eq in H by lra. apply (Rmult_le_reg_r (2 ^ n)); [exact P |].
    replace (c / 2 ^ n * 2 ^ n) with c by (field; lra).
    apply Rge_le, (Rmult_le_compat_r e) in H; [| lra]. replace (c / e * e) with c in H by (field; lra). lra.
Qed.

Lemma slab_area s t (A : point -> Prop) m : s <= t -> f s <= g s -> f t <= g t ->
  (forall x y, s < x < t -> f x < y < g x -> A (x, y)) ->
  m = (t - s) * (g s - f s + (g t - f t)) / 2 -> inner_ge A m.
Proof.
  intros H Ds Dt I -> e E. destruct (small_power ((Rabs q + Rabs w) * ((t - s) * (t - s))) e E) as [n N].
  destruct (slab_inner n s t H Ds Dt) as [L [W [D S]]]. exists L. split; [| split; [exact D | lra]].
  revert W. apply within_subset. intros [x y] [X Y]. now apply I.
Qed.
End Lines.

Lemma orient_rotate a b c : orient b c a = orient a b c.
Proof. unfold orient. ring. Qed.

Lemma orient_sum a b c z : orient a b z + orient b c z + orient c a z = orient a b c.
Proof. unfold orient. ring. Qed.

(* The line through a and b where it is not vertical. *)
Definition slope (a b : point) : R := (snd b - snd a) / (fst b - fst a).
Definition height (a b : point) : R := snd a - slope a b * fst a.

Lemma orient_line a b x y : fst a <> fst b ->
  orient a b (x, y) = (fst b - fst a) * (y - (height a b + slope a b * x)).
Proof. intros H. unfold orient, height, slope. simpl. field. lra. Qed.

(* abc turns left, and a, b, c go from left to right: two pieces, with a common side at b. *)
Lemma triangle_below a b c : 0 < orient a b c -> fst a <= fst b -> fst b <= fst c ->
  inner_ge (triangle a b c) (orient a b c / 2).
Proof.
  intros D AB BC. assert (AC : fst a < fst c).
  { destruct (Rle_lt_or_eq_dec (fst a) (fst c)) as [L | E]; [lra | exact L |].
    exfalso. unfold orient in D. replace (fst b - fst a) with 0 in D by lra. rewrite E in D. lra. }
  set (h := orient a b c / (fst c - fst a)).
  assert (Hh : 0 < h) by (apply Rdiv_lt_0_compat; lra).
  assert (Eh : orient a b c = (fst c - fst a) * h) by (unfold h; field; lra).
  set (k := height a c) in *. set (l := slope a c) in *.
  assert (Gb : k + l * fst b - snd b = h) by (unfold k, l, height, slope, h, orient; field; lra).
  assert (Ga : k + l * fst a = snd a) by (unfold k, height; fold l; ring).
  assert (Gc : k + l * fst c = snd c) by (unfold k, l, height, slope; field; lra).
  set (A z := triangle a b c z /\ fst z < fst b). set (C z := triangle a b c z /\ fst b < fst z).
  replace (orient a b c / 2) with ((fst b - fst a) * h / 2 + (fst c - fst b) * h / 2) by (rewrite Eh; field).
  apply (inner_union A C); unfold A, C; try tauto; [intros z; lra | |].
  - destruct (Rle_lt_or_eq_dec _ _ AB) as [L | E]; [| apply inner_trivial; rewrite E; lra].
    assert (Fa : height a b + slope a b * fst a = snd a) by (unfold height; ring).
    assert (Fb : height a b + slope a b * fst b = snd b) by (unfold height, slope; field; lra).
    apply (slab_area (height a b) (slope a b) k l (fst a) (fst b)); [lra | lra | lra | | rewrite Fa, Ga, Fb; rewrite <- Gb; field].
    intros x y X Y. split; [| exact (proj2 X)].
    assert (Oab : orient a b (x, y) = (fst b - fst a) * (y - (height a b + slope a b * x))) by (apply orient_line; lra).
    assert (Oca : orient c a (x, y) = (fst c - fst a) * (k + l * x - y)).
    { replace (orient c a (x, y)) with (- orient a c (x, y)) by (unfold orient; ring).
      rewrite orient_line by lra. fold k l. ring. }
    set (u := y - (height a b + slope a b * x)) in *. set (v := k + l * x - y) in *.
    assert (S : (fst b - fst a) * (u + v) = h * (x - fst a)).
    { unfold u, v. rewrite <- Gb, <- Fb. replace (height a b) with (k + l * fst a - slope a b * fst a) by lra. ring. }
    pose proof (orient_sum a b c (x, y)) as O. rewrite Oab, Oca, Eh in O.
    assert (u + v < h) by nra. assert (0 < u) by (unfold u; lra). assert (0 < v) by (unfold v; lra).
    unfold triangle. rewrite Oab, Oca. split; [nra |]. split; [| nra]. nra.
  - destruct (Rle_lt_or_eq_dec _ _ BC) as [L | E]; [| apply inner_trivial; rewrite E; lra].
    assert (Fb : height b c + slope b c * fst b = snd b) by (unfold height; ring).
    assert (Fc : height b c + slope b c * fst c = snd c) by (unfold height, slope; field; lra).
    apply (slab_area (height b c) (slope b c) k l (fst b) (fst c)); [lra | lra | lra | | rewrite Fc, Gc, Fb; rewrite <- Gb; field].
    intros x y X Y. split; [| exact (proj1 X)].
    assert (Obc : orient b c (x, y) = (fst c - fst b) * (y - (height b c + slope b c * x))) by (apply orient_line; lra).
    assert (Oca : orient c a (x, y) = (fst c - fst a) * (k + l * x - y)).
    { replace (orient c a (x, y)) with (- orient a c (x, y)) by (unfold orient; ring).
      rewrite orient_line by lra. fold k l. ring. }
    set (u := y - (height b c + slope b c * x)) in *. set (v := k + l * x - y) in *.
    assert (S : (fst c - fst b) * (u + v) = h * (fst c - x)).
    { unfold u, v. rewrite <- Gb, <- Fb. replace k with (height b c + slope b c * fst c - l * fst c) by lra. ring. }
    pose proof (orient_sum a b c (x, y)) as O. rewrite Obc, Oca, Eh in O.
    assert (u + v < h) by nra. assert (0 < u) by (unfold u; lra). assert (0 < v) by (unfold v; lra).
    unfold triangle. rewrite Obc, Oca. split; [| split; nra]. nra.
Qed.

(* abc turns left, and a, c, b go from left to right. *)
Lemma triangle_above a b c : 0 < orient a b c -> fst a <= fst c -> fst c <= fst b ->
  inner_ge (triangle a b c) (orient a b c / 2).
Proof.
  intros D AC CB. assert (AB : fst a < fst b).
  { destruct (Rle_lt_or_eq_dec (fst a) (fst b)) as [L | E]; [lra | exact L |].
    exfalso. unfold orient in D. replace (fst c - fst a) with 0 in D by lra. rewrite E in D. lra. }
  set (h := orient a b c / (fst b - fst a)).
  assert (Hh : 0 < h) by (apply Rdiv_lt_0_compat; lra).
  assert (Eh : orient a b c = (fst b - fst a) * h) by (unfold h; field; lra).
  set (k := height a b) in *. set (l := slope a b) in *.
  assert (Fc : snd c - (k + l * fst c) = h) by (unfold k, l, height, slope, h, orient; field; lra).
  assert (Fa : k + l * fst a = snd a) by (unfold k, height; fold l; ring).
  assert (Fb : k + l * fst b = snd b) by (unfold k, l, height, slope; field; lra).
  set (A z := triangle a b c z /\ fst z < fst c). set (B z := triangle a b c z /\ fst c < fst z).
  replace (orient a b c / 2) with ((fst c - fst a) * h / 2 + (fst b - fst c) * h / 2) by (rewrite Eh; field).
  apply (inner_union A B); unfold A, B; try tauto; [intros z; lra | |].
  - destruct (Rle_lt_or_eq_dec _ _ AC) as [L | E]; [| apply inner_trivial; rewrite E; lra].
    assert (Ga : height a c + slope a c * fst a = snd a) by (unfold height; ring).
    assert (Gc : height a c + slope a c * fst c = snd c) by (unfold height, slope; field; lra).
    apply (slab_area k l (height a c) (slope a c) (fst a) (fst c)); [lra | lra | lra | | rewrite Fa, Ga, Gc; rewrite <- Fc; field].
    intros x y X Y. split; [| exact (proj2 X)].
    assert (Oab : orient a b (x, y) = (fst b - fst a) * (y - (k + l * x))) by (apply orient_line; lra).
    assert (Oca : orient c a (x, y) = (fst c - fst a) * (height a c + slope a c * x - y)).
    { replace (orient c a (x, y)) with (- orient a c (x, y)) by (unfold orient; ring).
      rewrite orient_line by lra. ring. }
    set (u := y - (k + l * x)) in *. set (v := height a c + slope a c * x - y) in *.
    assert (S : (fst c - fst a) * (u + v) = h * (x - fst a)).
    { unfold u, v. rewrite <- Fc, <- Gc. replace k with (height a c + slope a c * fst a - l * fst a) by lra. ring. }
    pose proof (orient_sum a b c (x, y)) as O. rewrite Oab, Oca, Eh in O.
    assert (u + v < h) by nra. assert (0 < u) by (unfold u; lra). assert (0 < v) by (unfold v; lra).
    unfold triangle. rewrite Oab, Oca. split; [nra |]. split; [| nra]. nra.
  - destruct (Rle_lt_or_eq_dec _ _ CB) as [L | E]; [| apply inner_trivial; rewrite E; lra].
    assert (Gc : height c b + slope c b * fst c = snd c) by (unfold height; ring).
    assert (Gb : height c b + slope c b * fst b = snd b) by (unfold height, slope; field; lra).
    apply (slab_area k l (height c b) (slope c b) (fst c) (fst b)); [lra | lra | lra | | rewrite Fb, Gb, Gc; rewrite <- Fc; field].
    intros x y X Y. split; [| exact (proj1 X)].
    assert (Oab : orient a b (x, y) = (fst b - fst a) * (y - (k + l * x))) by (apply orient_line; lra).
    assert (Obc : orient b c (x, y) = (fst b - fst c) * (height c b + slope c b * x - y)).
    { replace (orient b c (x, y)) with (- orient c b (x, y)) by (unfold orient; ring).
      rewrite orient_line by lra. ring. }
    set (u := y - (k + l * x)) in *. set (v := height c b + slope c b * x - y) in *.
    assert (S : (fst b - fst c) * (u + v) = h * (fst b - x)).
    { unfold u, v. rewrite <- Fc, <- Gc. replace k with (height c b + slope c b * fst b - l * fst b) by lra. ring. }
    pose proof (orient_sum a b c (x, y)) as O. rewrite Oab, Obc, Eh in O.
    assert (u + v < h) by nra. assert (0 < u) by (unfold u; lra). assert (0 < v) by (unfold v; lra).
    unfold triangle. rewrite Oab, Obc. split; [| split; nra]. nra.
Qed.

Lemma triangle_from_left a b c : fst a <= fst b -> fst a <= fst c -> inner_ge (triangle a b c) (orient a b c / 2).
Proof.
  intros B C. destruct (Rle_dec (orient a b c) 0) as [N | N]; [apply inner_trivial; lra |].
  destruct (Rle_dec (fst b) (fst c)); [apply triangle_below | apply triangle_above]; lra.
Qed.

Theorem triangle_inner a b c : inner_ge (triangle a b c) (orient a b c / 2).
Proof.
  assert (R : forall a b c m, inner_ge (triangle b c a) m -> inner_ge (triangle a b c) m).
  { intros x y z m. apply inner_subset; [unfold triangle; tauto | lra]. }
  destruct (Rle_dec (fst a) (fst b)); destruct (Rle_dec (fst a) (fst c)); destruct (Rle_dec (fst b) (fst c));
    try (apply triangle_from_left; lra);
    rewrite <- orient_rotate; apply R; try (apply triangle_from_left; lra);
    rewrite <- orient_rotate; apply R; apply triangle_from_left; lra.
Qed.

(* Points of a triangle are means of its vertices with positive weights. *)
Lemma triangle_mean a b c z : triangle a b c z -> exists u v w, 0 < u /\ 0 < v /\ 0 < w /\ u + v + w = 1 /\
  fst z = u * fst a + v * fst b + w * fst c /\ snd z = u * snd a + v * snd b + w * snd c.
Proof.
  intros [C [A B]]. pose proof (orient_sum a b c z) as S. set (d := orient a b c) in *.
  assert (D : 0 < d) by lra.
  exists (orient b c z / d), (orient c a z / d), (orient a b z / d).
  repeat (split; [now apply Rdiv_lt_0_compat |]). split; [rewrite <- S; field; lra |].
  split; apply (Rmult_eq_reg_l d); try lra; unfold d, orient; field; fold (orient a b c); fold d; lra.
Qed.

(* A line with the vertices on one side has the triangle there. *)
Lemma triangle_side p q a b c z : triangle a b c z -> 0 <= orient p q a -> 0 <= orient p q b -> 0 <= orient p q c ->
  0 <= orient p q z.
Proof.
  intros T A B C. destruct (triangle_mean a b c z T) as [u [v [w [U [V [W [S [X Y]]]]]]]].
  replace (orient p q z) with (u * orient p q a + v * orient p q b + w * orient p q c).
  - repeat apply Rplus_le_le_0_compat; apply Rmult_le_pos; lra.
  - unfold orient. rewrite X, Y. replace u with (1 - v - w) by lra. ring.
Qed.
