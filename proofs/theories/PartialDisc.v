(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The partial disc (I,E) of three surely oriented rectangles, and Con: three critical circles decide "inside every
   circle", the three others decide "outside every circle". *)
From Coq Require Import Reals Lra Psatz Classical.
From Dyadel Require Import Plane Distance Orientation Disc.
Open Scope R_scope.

(* The three circles with one F bound I, the three with two F bound E. *)
Record once (X Y Z : rect) : Type := Once {
  o1 : point; r1 : R; fcc : critical F C C X Y Z o1 r1;
  o2 : point; r2 : R; cfc : critical C F C X Y Z o2 r2;
  o3 : point; r3 : R; ccf : critical C C F X Y Z o3 r3 }.
Record twice (X Y Z : rect) : Type := Twice {
  o4 : point; r4 : R; cff : critical C F F X Y Z o4 r4;
  o5 : point; r5 : R; fcf : critical F C F X Y Z o5 r5;
  o6 : point; r6 : R; ffc : critical F F C X Y Z o6 r6 }.

Arguments o1 {X Y Z}. Arguments r1 {X Y Z}. Arguments fcc {X Y Z}.
Arguments o2 {X Y Z}. Arguments r2 {X Y Z}. Arguments cfc {X Y Z}.
Arguments o3 {X Y Z}. Arguments r3 {X Y Z}. Arguments ccf {X Y Z}.
Arguments o4 {X Y Z}. Arguments r4 {X Y Z}. Arguments cff {X Y Z}.
Arguments o5 {X Y Z}. Arguments r5 {X Y Z}. Arguments fcf {X Y Z}.
Arguments o6 {X Y Z}. Arguments r6 {X Y Z}. Arguments ffc {X Y Z}.

Definition in_three {X Y Z} (K : once X Y Z) (w : point) : Prop :=
  dist (o1 K) w < r1 K /\ dist (o2 K) w < r2 K /\ dist (o3 K) w < r3 K.
Definition out_of_three {X Y Z} (M : twice X Y Z) (w : point) : Prop :=
  r4 M < dist (o4 M) w /\ r5 M < dist (o5 M) w /\ r6 M < dist (o6 M) w.

(* Strictly inside, strictly outside all circles through points of the three rectangles. *)
Definition in_all (X Y Z : rect) (w : point) : Prop :=
  forall x y z o r, inside x X -> inside y Y -> inside z Z -> circle o r x y z -> dist o w < r.
Definition out_of_all (X Y Z : rect) (w : point) : Prop :=
  forall x y z o r, inside x X -> inside y Y -> inside z Z -> circle o r x y z -> r < dist o w.

Lemma touching_point l o r B : touches l o r B -> exists x, inside x B /\ dist o x = r.
Proof.
  destruct l; simpl; intros H.
  - exists (farthest o B). split; [apply farthest_inside | exact H].
  - exists (nearest o B). split; [apply nearest_inside | exact H].
Qed.

(* A critical circle is one of the circles. *)
Lemma critical_is_circle l m n X Y Z o r : critical l m n X Y Z o r ->
  exists x y z, inside x X /\ inside y Y /\ inside z Z /\ circle o r x y z.
Proof.
  intros [H [G K]]. destruct (touching_point _ _ _ _ H) as [x [Ix Ex]].
  destruct (touching_point _ _ _ _ G) as [y [Iy Ey]]. destruct (touching_point _ _ _ _ K) as [z [Iz Ez]].
  now exists x, y, z.
Qed.

Lemma touches_nonneg l o r B : touches l o r B -> 0 <= r.
Proof. destruct l; simpl; intros <-; [apply dl_nonneg | apply ds_nonneg]. Qed.

(* How the power of a point of a rectangle compares with that of a circle through it. *)
Lemma far_radical o r B o' r' x : touches F o r B -> inside x B -> dist o' x = r' -> radical o r o' r' x <= 0.
Proof.
  intros H I E. unfold radical. rewrite (power_zero o' r' x E).
  assert (power o r x <= 0) by (apply power_le; rewrite <- H; now apply le_dl). lra.
Qed.

Lemma near_radical o r B o' r' x : touches C o r B -> inside x B -> dist o' x = r' -> 0 <= radical o r o' r' x.
Proof.
  intros H I E. unfold radical. rewrite (power_zero o' r' x E).
  assert (0 <= power o r x).
  { apply power_ge; [apply (touches_nonneg C o r B H) |]. rewrite <- H. now apply ds_le. }
  lra.
Qed.

Section Three.
Variables (X Y Z : rect).
Variable oriented : surely_left X Y Z.
Variables (K : once X Y Z) (M : twice X Y Z).

Lemma distinct_points x y z : inside x X -> inside y Y -> inside z Z ->
  0 < dist2 x y /\ 0 < dist2 y z /\ 0 < dist2 x z.
Proof.
  intros Ix Iy Iz. pose proof (oriented x y z Ix Iy Iz) as D.
  assert (P : forall a b, a <> b -> 0 < dist2 a b).
  { intros a b N. pose proof (dist_pos a b N). rewrite <- dist_sq. nra. }
  repeat split; apply P; intros ->; unfold orient in D; nra.
Qed.

(* A point inside the three circles for I is on no circle. *)
Lemma inner_not_on_circle x y z o r w : inside x X -> inside y Y -> inside z Z -> circle o r x y z -> dist o w = r ->
  ~ in_three K w.
Proof.
  intros Ix Iy Iz H W. destruct (distinct_points x y z Ix Iy Iz) as [XY [YZ XZ]].
  pose proof (oriented x y z Ix Iy Iz) as D. pose proof (cocircular_barycentric o r x y z w H W) as E.
  destruct H as [Hx [Hy Hz]].
  assert (S : orient w y z + orient x w z + orient x y w = orient x y z) by (unfold orient; ring).
  intros [W1 [W2 W3]].
  destruct (fcc K) as [A1 [A2 A3]]. destruct (cfc K) as [B1 [B2 B3]]. destruct (ccf K) as [C1 [C2 C3]].
  apply power_lt in W1, W2, W3. pose proof (power_zero o r w W) as Wz.
  refine (not_next_to_three (orient w y z) (orient x w z) (orient x y w) x y z _ _ _ _ _ _ _ _ _ _ XY YZ XZ _
    (far_radical _ _ _ o r x A1 Ix Hx) (near_radical _ _ _ o r y A2 Iy Hy) (near_radical _ _ _ o r z A3 Iz Hz) _
    (near_radical _ _ _ o r x B1 Ix Hx) (far_radical _ _ _ o r y B2 Iy Hy) (near_radical _ _ _ o r z B3 Iz Hz) _
    (near_radical _ _ _ o r x C1 Ix Hx) (near_radical _ _ _ o r y C2 Iy Hy) (far_radical _ _ _ o r z C3 Iz Hz) _);
    try lra; rewrite <- radical_barycentric; unfold radical; rewrite Wz; nra.
Qed.

(* Nor is a point outside the three for E. *)
Lemma outer_not_on_circle x y z o r w : inside x X -> inside y Y -> inside z Z -> circle o r x y z -> dist o w = r ->
  ~ out_of_three M w.
Proof.
  intros Ix Iy Iz H W. destruct (distinct_points x y z Ix Iy Iz) as [XY [YZ XZ]].
  pose proof (oriented x y z Ix Iy Iz) as D. pose proof (cocircular_barycentric o r x y z w H W) as E.
  destruct H as [Hx [Hy Hz]].
  assert (S : orient w y z + orient x w z + orient x y w = orient x y z) by (unfold orient; ring).
  intros [W1 [W2 W3]].
  destruct (cff M) as [A1 [A2 A3]]. destruct (fcf M) as [B1 [B2 B3]]. destruct (ffc M) as [C1 [C2 C3]].
  apply power_gt in W1; [| apply (touches_nonneg _ _ _ _ A1)].
  apply power_gt in W2; [| apply (touches_nonneg _ _ _ _ B1)].
  apply power_gt in W3; [| apply (touches_nonneg _ _ _ _ C1)]. pose proof (power_zero o r w W) as Wz.
  pose proof (near_radical _ _ _ o r x A1 Ix Hx) as a1. pose proof (far_radical _ _ _ o r y A2 Iy Hy) as a2.
  pose proof (far_radical _ _ _ o r z A3 Iz Hz) as a3. pose proof (far_radical _ _ _ o r x B1 Ix Hx) as b1.
  pose proof (near_radical _ _ _ o r y B2 Iy Hy) as b2. pose proof (far_radical _ _ _ o r z B3 Iz Hz) as b3.
  pose proof (far_radical _ _ _ o r x C1 Ix Hx) as c1. pose proof (far_radical _ _ _ o r y C2 Iy Hy) as c2.
  pose proof (near_radical _ _ _ o r z C3 Iz Hz) as c3.
  pose proof (radical_barycentric (o4 M) (r4 M) o r x y z w) as La.
  pose proof (radical_barycentric (o5 M) (r5 M) o r x y z w) as Lb.
  pose proof (radical_barycentric (o6 M) (r6 M) o r x y z w) as Lc.
  assert (Pa : 0 < orient x y z * radical (o4 M) (r4 M) o r w) by (unfold radical; rewrite Wz; nra).
  assert (Pb : 0 < orient x y z * radical (o5 M) (r5 M) o r w) by (unfold radical; rewrite Wz; nra).
  assert (Pc : 0 < orient x y z * radical (o6 M) (r6 M) o r w) by (unfold radical; rewrite Wz; nra).
  apply (not_next_to_three (orient w y z) (orient x w z) (orient x y w) x y z
    (- radical (o4 M) (r4 M) o r x) (- radical (o4 M) (r4 M) o r y) (- radical (o4 M) (r4 M) o r z)
    (- radical (o5 M) (r5 M) o r x) (- radical (o5 M) (r5 M) o r y) (- radical (o5 M) (r5 M) o r z)
    (- radical (o6 M) (r6 M) o r x) (- radical (o6 M) (r6 M) o r y) (- radical (o6 M) (r6 M) o r z)); lra.
Qed.

(* Along a path of choices, from w inside its circle to w' outside its circle, some choice is on one circle. *)
Lemma on_the_way x y z o r w x' y' z' o' r' w' :
  inside x X -> inside y Y -> inside z Z -> circle o r x y z -> power o r w <= 0 ->
  inside x' X -> inside y' Y -> inside z' Z -> circle o' r' x' y' z' -> 0 <= power o' r' w' ->
  exists t a b c q s, 0 <= t <= 1 /\ inside a X /\ inside b Y /\ inside c Z /\ 0 <= s /\ circle q s a b c /\
    dist q (mix t w w') = s.
Proof.
  intros Ix Iy Iz H L Ix' Iy' Iz' H' G.
  set (f t := - incircle (mix t x x') (mix t y y') (mix t z z') (mix t w w')).
  destruct (intermediate f) as [t [T E]].
  - unfold f, incircle, dist2, orient, mix. simpl. reg.
  - unfold f. rewrite !mix_0, (incircle_power o r) by exact H. pose proof (oriented x y z Ix Iy Iz). nra.
  - unfold f. rewrite !mix_1, (incircle_power o' r') by exact H'. pose proof (oriented x' y' z' Ix' Iy' Iz'). nra.
  - pose proof (inside_convex t x x' X T Ix Ix') as Ia. pose proof (inside_convex t y y' Y T Iy Iy') as Ib.
    pose proof (inside_convex t z z' Z T Iz Iz') as Ic. pose proof (oriented _ _ _ Ia Ib Ic) as D.
    destruct (circumcentre (mix t x x') (mix t y y') (mix t z z')) as [q [s [S Q]]]; [lra |].
    exists t, (mix t x x'), (mix t y y'), (mix t z z'), q, s.
    refine (conj T (conj Ia (conj Ib (conj Ic (conj S (conj Q _)))))).
    unfold f in E. rewrite (incircle_power q s) in E by exact Q.
    assert (P : power q s (mix t w w') = 0).
    { apply (Rmult_eq_reg_l (orient (mix t x x') (mix t y y') (mix t z z'))); lra. }
    unfold power in P. rewrite <- dist_sq in P.
    apply Rsqr_inj; [apply dist_nonneg | exact S | unfold Rsqr; lra].
Qed.

(* I: inside the three circles with one F iff inside all circles. *)
Theorem inner_exact w : in_three K w <-> in_all X Y Z w.
Proof.
  split.
  - intros H x y z o r Ix Iy Iz Q. apply Rnot_le_lt. intros L.
    assert (R0 : 0 <= r) by (destruct Q as [<- _]; apply dist_nonneg).
    destruct (critical_is_circle _ _ _ _ _ _ _ _ (fcc K)) as [a [b [c [Ia [Ib [Ic Q1]]]]]].
    destruct (on_the_way a b c _ _ w x y z o r w Ia Ib Ic Q1) as [t [a' [b' [c' [q [s [T [Ia' [Ib' [Ic' [_ [Q' E]]]]]]]]]]]];
      try assumption.
    + apply power_le. destruct H. lra.
    + now apply power_ge.
    + assert (Same : mix t w w = w) by (destruct w; unfold mix; simpl; f_equal; ring). rewrite Same in E.
      exact (inner_not_on_circle a' b' c' q s w Ia' Ib' Ic' Q' E H).
  - intros H. repeat split.
    + destruct (critical_is_circle _ _ _ _ _ _ _ _ (fcc K)) as [a [b [c [Ia [Ib [Ic Q]]]]]]. now apply (H a b c).
    + destruct (critical_is_circle _ _ _ _ _ _ _ _ (cfc K)) as [a [b [c [Ia [Ib [Ic Q]]]]]]. now apply (H a b c).
    + destruct (critical_is_circle _ _ _ _ _ _ _ _ (ccf K)) as [a [b [c [Ia [Ib [Ic Q]]]]]]. now apply (H a b c).
Qed.

(* E: outside the three circles with two F iff outside all circles. *)
Theorem outer_exact w : out_of_three M w <-> out_of_all X Y Z w.
Proof.
  split.
  - intros H x y z o r Ix Iy Iz Q. apply Rnot_le_lt. intros L.
    destruct (critical_is_circle _ _ _ _ _ _ _ _ (cff M)) as [a [b [c [Ia [Ib [Ic Q1]]]]]].
    destruct (on_the_way x y z o r w a b c (o4 M) (r4 M) w Ix Iy Iz Q) as [t [a' [b' [c' [q [s [T [Ia' [Ib' [Ic' [_ [Q' E]]]]]]]]]]]];
      [now apply power_le | exact Ia | exact Ib | exact Ic | exact Q1 | |].
    + apply power_ge; [| destruct H; lra]. destruct (cff M) as [A _]. apply (touches_nonneg _ _ _ _ A).
    + assert (Same : mix t w w = w) by (destruct w; unfold mix; simpl; f_equal; ring). rewrite Same in E.
      exact (outer_not_on_circle a' b' c' q s w Ia' Ib' Ic' Q' E H).
  - intros H. repeat split.
    + destruct (critical_is_circle _ _ _ _ _ _ _ _ (cff M)) as [a [b [c [Ia [Ib [Ic Q]]]]]]. now apply (H a b c).
    + destruct (critical_is_circle _ _ _ _ _ _ _ _ (fcf M)) as [a [b [c [Ia [Ib [Ic Q]]]]]]. now apply (H a b c).
    + destruct (critical_is_circle _ _ _ _ _ _ _ _ (ffc M)) as [a [b [c [Ia [Ib [Ic Q]]]]]]. now apply (H a b c).
Qed.

(* Con of a fourth rectangle: + and - by the largest and smallest distances from the six centres. *)
Definition con_plus (W : rect) : Prop := dl (o1 K) W < r1 K /\ dl (o2 K) W < r2 K /\ dl (o3 K) W < r3 K.
Definition con_minus (W : rect) : Prop := r4 M < ds (o4 M) W /\ r5 M < ds (o5 M) W /\ r6 M < ds (o6 M) W.

Theorem con_plus_exact W : con_plus W <-> forall w, inside w W -> in_all X Y Z w.
Proof.
  split.
  - intros [A [H G]] w I. apply inner_exact. pose proof (le_dl (o1 K) W w I). pose proof (le_dl (o2 K) W w I).
    pose proof (le_dl (o3 K) W w I). unfold in_three. lra.
  - intros H. repeat split.
    + apply (inner_exact (farthest (o1 K) W)), H, farthest_inside.
    + apply (inner_exact (farthest (o2 K) W)), H, farthest_inside.
    + apply (inner_exact (farthest (o3 K) W)), H, farthest_inside.
Qed.

Theorem con_minus_exact W : con_minus W <-> forall w, inside w W -> out_of_all X Y Z w.
Proof.
  split.
  - intros [A [H G]] w I. apply outer_exact. pose proof (ds_le (o4 M) W w I). pose proof (ds_le (o5 M) W w I).
    pose proof (ds_le (o6 M) W w I). unfold out_of_three. lra.
  - intros H. repeat split.
    + apply (outer_exact (nearest (o4 M) W)), H, nearest_inside.
    + apply (outer_exact (nearest (o5 M) W)), H, nearest_inside.
    + apply (outer_exact (nearest (o6 M) W)), H, nearest_inside.
Qed.

(* Con is unknown iff some circle meets all four rectangles. *)
Theorem con_unknown_exact W : (~ con_plus W /\ ~ con_minus W) <->
  exists x y z w o r, inside x X /\ inside y Y /\ inside z Z /\ inside w W /\ circle o r x y z /\ dist o w = r.
Proof.
  split.
  - intros [NP NM].
    assert (A : exists w' x' y' z' o' r', inside w' W /\ inside x' X /\ inside y' Y /\ inside z' Z /\
      circle o' r' x' y' z' /\ r' <= dist o' w').
    { apply NNPP. intros E. apply NP, con_plus_exact. intros w Iw x y z o r Ix Iy Iz Q. apply Rnot_le_lt. intros L.
      apply E. now exists w, x, y, z, o, r. }
    assert (H : exists w x y z o r, inside w W /\ inside x X /\ inside y Y /\ inside z Z /\
      circle o r x y z /\ dist o w <= r).
    { apply NNPP. intros E. apply NM, con_minus_exact. intros w Iw x y z o r Ix Iy Iz Q. apply Rnot_le_lt. intros L.
      apply E. now exists w, x, y, z, o, r. }
    destruct A as [w' [x' [y' [z' [o' [r' [Iw' [Ix' [Iy' [Iz' [Q' L']]]]]]]]]]].
    destruct H as [w [x [y [z [o [r [Iw [Ix [Iy [Iz [Q L]]]]]]]]]]].
    assert (R0 : 0 <= r') by (destruct Q' as [<- _]; apply dist_nonneg).
    destruct (on_the_way x y z o r w x' y' z' o' r' w' Ix Iy Iz Q (power_le _ _ _ L) Ix' Iy' Iz' Q' (power_ge _ _ _ R0 L'))
      as [t [a [b [c [q [s [T [Ia [Ib [Ic [_ [Q2 E]]]]]]]]]]]].
    exists a, b, c, (mix t w w'), q, s.
    refine (conj Ia (conj Ib (conj Ic (conj _ (conj Q2 E))))). now apply inside_convex.
  - intros [x [y [z [w [o [r [Ix [Iy [Iz [Iw [Q E]]]]]]]]]]]. split; intros H.
    + pose proof (proj1 (con_plus_exact W) H w Iw x y z o r Ix Iy Iz Q). lra.
    + pose proof (proj1 (con_minus_exact W) H w Iw x y z o r Ix Iy Iz Q). lra.
Qed.
End Three.

(* Either orientation: exchange two of the three rectangles. *)
Lemma critical_swap l m n X Y Z o r : critical l m n X Y Z o r -> critical l n m X Z Y o r.
Proof. intros [A [H G]]. now repeat split. Qed.

Definition swap_once {X Y Z} (K : once X Y Z) : once X Z Y := Once X Z Y
  (o1 K) (r1 K) (critical_swap _ _ _ _ _ _ _ _ (fcc K)) (o3 K) (r3 K) (critical_swap _ _ _ _ _ _ _ _ (ccf K))
  (o2 K) (r2 K) (critical_swap _ _ _ _ _ _ _ _ (cfc K)).
Definition swap_twice {X Y Z} (M : twice X Y Z) : twice X Z Y := Twice X Z Y
  (o4 M) (r4 M) (critical_swap _ _ _ _ _ _ _ _ (cff M)) (o6 M) (r6 M) (critical_swap _ _ _ _ _ _ _ _ (ffc M))
  (o5 M) (r5 M) (critical_swap _ _ _ _ _ _ _ _ (fcf M)).

Lemma circle_swap o r x y z : circle o r x y z -> circle o r x z y.
Proof. intros [A [H G]]. now repeat split. Qed.

Definition surely_oriented (X Y Z : rect) : Prop := surely_left X Y Z \/ surely_right X Y Z.

(* Con is + iff W is strictly inside all circles: three critical circles decide. *)
Theorem con_plus_decided X Y Z (K : once X Y Z) W : surely_oriented X Y Z ->
  (con_plus X Y Z K W <-> forall w, inside w W -> in_all X Y Z w).
Proof.
  intros [S | S]; [now apply con_plus_exact |]. apply surely_right_left in S.
  assert (P : con_plus X Y Z K W <-> con_plus X Z Y (swap_once K) W) by (unfold con_plus; simpl; tauto).
  rewrite P, con_plus_exact by exact S.
  split; intros H w I x y z o r Ix Iy Iz Q; apply (H w I x z y o r Ix Iz Iy (circle_swap _ _ _ _ _ Q)).
Qed.

(* Con is - iff W is strictly outside all circles: the three others decide. *)
Theorem con_minus_decided X Y Z (M : twice X Y Z) W : surely_oriented X Y Z ->
  (con_minus X Y Z M W <-> forall w, inside w W -> out_of_all X Y Z w).
Proof.
  intros [S | S]; [now apply con_minus_exact |]. apply surely_right_left in S.
  assert (P : con_minus X Y Z M W <-> con_minus X Z Y (swap_twice M) W) by (unfold con_minus; simpl; tauto).
  rewrite P, con_minus_exact by exact S.
  split; intros H w I x y z o r Ix Iy Iz Q; apply (H w I x z y o r Ix Iz Iy (circle_swap _ _ _ _ _ Q)).
Qed.

(* Otherwise a circle meets all four rectangles. *)
Theorem con_unknown_decided X Y Z (K : once X Y Z) (M : twice X Y Z) W : surely_oriented X Y Z ->
  ((~ con_plus X Y Z K W /\ ~ con_minus X Y Z M W) <->
    exists x y z w o r, inside x X /\ inside y Y /\ inside z Z /\ inside w W /\ circle o r x y z /\ dist o w = r).
Proof.
  intros [S | S]; [now apply con_unknown_exact |]. apply surely_right_left in S.
  assert (P : con_plus X Y Z K W <-> con_plus X Z Y (swap_once K) W) by (unfold con_plus; simpl; tauto).
  assert (P' : con_minus X Y Z M W <-> con_minus X Z Y (swap_twice M) W) by (unfold con_minus; simpl; tauto).
  rewrite P, P', con_unknown_exact by exact S.
  split; intros [x [y [z [w [o [r [Ix [Iy [Iz [Iw [Q E]]]]]]]]]]]; exists x, z, y, w, o, r;
    exact (conj Ix (conj Iz (conj Iy (conj Iw (conj (circle_swap _ _ _ _ _ Q) E))))).
Qed.
