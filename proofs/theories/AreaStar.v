(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A polygon that turns left round a point o all the way, and crosses the level of o upwards once: dyd_filter_shape
   requires this of the polygons in doubles. Its triangles with o do not overlap, so it holds the sum of their areas;
   and o is in every convex set with the vertices. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Dyadel Require Import Plane Distance Cells Orientation VoronoiBounds.
From Dyadel Require Import Measure MeasureTriangle AreaVoronoi AreaChains.
Import ListNotations.
Open Scope R_scope.

(* The closed chain c goes left round o; how often it crosses the level of o upwards. *)
Definition left_round (o : point) (c : list point) : Prop := steps (fun a b => 0 < orient o a b) c.
Definition rises (o a b : point) : nat :=
  if Rlt_dec (snd a) (snd o) then if Rle_dec (snd o) (snd b) then 1%nat else 0%nat else 0%nat.
Fixpoint crossings (o : point) (c : list point) : nat :=
  match c with a :: ((b :: _) as r) => (rises o a b + crossings o r)%nat | _ => 0%nat end.

(* ---- chains in parts ---- *)

Lemma crossings_app o k x l : crossings o (k ++ x :: l) = (crossings o (k ++ [x]) + crossings o (x :: l))%nat.
Proof.
  induction k as [| a k IH]; [reflexivity |]. destruct k as [| b k]; [simpl; lia |]. simpl in *. lia.
Qed.

Lemma area_app o k x l : fan_area2 o (k ++ x :: l) = fan_area2 o (k ++ [x]) + fan_area2 o (x :: l).
Proof.
  induction k as [| a k IH]; [simpl; ring |]. destruct k as [| b k]; [simpl; ring |]. simpl in *. lra.
Qed.

Lemma fan_app o k x l z : fan o (k ++ x :: l) z <-> fan o (k ++ [x]) z \/ fan o (x :: l) z.
Proof.
  induction k as [| a k IH]; [simpl; tauto |]. destruct k as [| b k]; [simpl; tauto |]. simpl in *. tauto.
Qed.

Lemma steps_app R k x l : steps R (k ++ x :: l) <-> steps R (k ++ [x]) /\ steps R (x :: l).
Proof.
  induction k as [| a k IH]; [simpl; tauto |]. destruct k as [| b k]; [simpl; tauto |]. simpl in *. tauto.
Qed.

Lemma crossings_cons o a b c : crossings o (a :: b :: c) = (rises o a b + crossings o (b :: c))%nat.
Proof. reflexivity. Qed.

(* The one edge that rises. *)
Lemma find_rise o c : crossings o c = 1%nat -> exists k a b l, c = k ++ a :: b :: l /\
  snd a < snd o <= snd b /\ crossings o (k ++ [a]) = 0%nat /\ crossings o (b :: l) = 0%nat.
Proof.
  induction c as [| d c IH]; [easy |]. destruct c as [| e c]; [easy |]. rewrite crossings_cons. intros H.
  destruct (Nat.eq_dec (rises o d e) 0) as [E | E].
  - destruct IH as [k [a [b [l [Eq [S [A B]]]]]]]; [lia |]. exists (d :: k), a, b, l.
    split; [rewrite Eq; reflexivity |]. split; [exact S |]. split; [| exact B].
    destruct k as [| f k]; inversion Eq; subst; simpl app; rewrite crossings_cons, E; [reflexivity | exact A].
  - exists [], d, e, c. split; [reflexivity |]. revert E H. unfold rises.
    destruct (Rlt_dec (snd d) (snd o)); [| lia]. destruct (Rle_dec (snd o) (snd e)); [| lia]. intros _ H.
    split; [lra |]. split; [reflexivity | lia].
Qed.

(* Without one, a chain is high, then low. *)
Lemma high_then_low o c : crossings o c = 0%nat -> exists u l, c = u ++ l /\
  Forall (fun v => snd o <= snd v) u /\ Forall (fun v => snd v < snd o) l.
Proof.
  induction c as [| a c IH]; intros H; [exists [], []; now repeat constructor |].
  destruct IH as [u [l [-> [U L]]]].
  { destruct c; [reflexivity |]. rewrite crossings_cons in H. lia. }
  destruct (Rlt_dec (snd a) (snd o)) as [A | A].
  - destruct u as [| b u].
    + exists [], (a :: l). split; [reflexivity |]. split; [constructor | now constructor].
    + exfalso. inversion U as [| ? ? B _]; subst. simpl app in H. rewrite crossings_cons in H. revert H. unfold rises.
      destruct (Rlt_dec (snd a) (snd o)); [| lra]. destruct (Rle_dec (snd o) (snd b)); [lia | lra].
  - exists (a :: u), l. split; [reflexivity |]. split; [constructor; [lra | exact U] | exact L].
Qed.

(* ---- chains on one side of o ---- *)

Lemma orient_levels o a b c : (snd b - snd o) * orient o a c =
  (snd c - snd o) * orient o a b + (snd a - snd o) * orient o b c.
Proof. unfold orient. ring. Qed.

Lemma rising_start o a b : snd o <= snd a -> snd o <= snd b -> 0 < orient o a b ->
  snd o < snd a \/ (snd a = snd o /\ fst o < fst a).
Proof.
  intros A B H. destruct (Rle_lt_or_eq_dec _ _ A) as [L | E]; [now left | right]. split; [lra |].
  unfold orient in H. rewrite <- E in H. nra.
Qed.

Lemma high_in_order o l : Forall (fun v => snd o <= snd v) l -> left_round o l -> in_order o l.
Proof.
  induction l as [| a l IH]; [constructor |]. intros F S. inversion F as [| ? ? A F']; subst.
  assert (D : in_order o l) by (apply IH; [exact F' | destruct l; [exact Logic.I | apply S]]).
  constructor; [| exact D]. destruct l as [| b l]; [constructor |]. destruct S as [H S].
  inversion F' as [| ? ? B F'']; subst. inversion D as [| ? ? G _]; subst. constructor; [lra |].
  destruct l as [| c l]; [constructor |]. destruct S as [H' _]. inversion F'' as [| ? ? C _]; subst.
  assert (P : snd o < snd b).
  { destruct (rising_start o b c B C H') as [L | [E L]]; [exact L |]. exfalso. unfold orient in H. rewrite E in H. nra. }
  rewrite Forall_forall in *. intros x I. specialize (G x I). specialize (F'' x I).
  pose proof (orient_levels o a b x). assert (0 <= (snd b - snd o) * orient o a x).
  { rewrite H0. apply Rplus_le_le_0_compat; apply Rmult_le_pos; lra. }
  apply (Rmult_le_reg_l (snd b - snd o)); lra.
Qed.

Lemma low_in_order o l : Forall (fun v => snd v < snd o) l -> left_round o l -> in_order o l.
Proof.
  induction l as [| a l IH]; [constructor |]. intros F S. inversion F as [| ? ? A F']; subst.
  assert (D : in_order o l) by (apply IH; [exact F' | destruct l; [exact Logic.I | apply S]]).
  constructor; [| exact D]. destruct l as [| b l]; [constructor |]. destruct S as [H S].
  inversion F' as [| ? ? B F'']; subst. inversion D as [| ? ? G _]; subst. constructor; [lra |].
  rewrite Forall_forall in *. intros x I. specialize (G x I). specialize (F'' x I).
  pose proof (orient_levels o a b x). assert (0 <= (snd o - snd b) * orient o a x).
  { replace ((snd o - snd b) * orient o a x) with ((snd o - snd x) * orient o a b + (snd o - snd a) * orient o b x) by lra.
    apply Rplus_le_le_0_compat; apply Rmult_le_pos; lra. }
  apply (Rmult_le_reg_l (snd o - snd b)); lra.
Qed.

Lemma fan_high o l z : Forall (fun v => snd o <= snd v) l -> fan o l z -> snd o <= snd z.
Proof.
  intros F H. apply (fan_in_convex (fun v => snd o <= snd v) o l z); [| lra | now apply Forall_forall | exact H].
  intros x y t T X Y. unfold mix. simpl. nra.
Qed.

Lemma fan_low o l z : Forall (fun v => snd v < snd o) l -> fan o l z -> snd z < snd o.
Proof.
  induction l as [| a l IH]; [intros _ [] |]. destruct l as [| b l]; [intros _ [] |]. intros F [T | T].
  - inversion F as [| ? ? A F']; subst. inversion F' as [| ? ? B _]; subst.
    destruct (triangle_mean o a b z T) as [u [v [w [U [V [W [S [_ Y]]]]]]]]. rewrite Y. replace u with (1 - v - w) by lra. nra.
  - apply IH; [now inversion F | exact T].
Qed.

Lemma in_order_last o l p : in_order o (l ++ [p]) -> Forall (fun v => 0 <= orient p o v) (l ++ [p]).
Proof.
  intros H. destruct (pairs_app_inv _ _ _ H) as [_ [_ C]]. apply Forall_forall. intros v I. apply in_app_or in I.
  destruct I as [I | [<- | []]]; [| unfold orient; lra].
  specialize (C v p I (or_introl eq_refl)). unfold orient in *. lra.
Qed.

Lemma in_order_first o l b : in_order o (b :: l) -> Forall (fun v => 0 <= orient o b v) (b :: l).
Proof. intros H. inversion H as [| ? ? F _]; subst. constructor; [unfold orient; lra | exact F]. Qed.

(* ---- the two edges that cross the level ---- *)

(* u goes from b to p, high; l from q to a, low; pq goes down, ab up. *)
Lemma round_inner o u l b p q a : (exists v, u = b :: v) -> (exists v, u = v ++ [p]) ->
  (exists v, l = q :: v) -> (exists v, l = v ++ [a]) ->
  Forall (fun v => snd o <= snd v) u -> Forall (fun v => snd v < snd o) l -> left_round o u -> left_round o l ->
  inner_ge (fun z => (fan o u z \/ fan o l z) \/ (triangle o p q z \/ triangle o a b z))
           (fan_area2 o u / 2 + fan_area2 o l / 2 + (orient o p q / 2 + orient o a b / 2)).
Proof.
  intros Ub Up Lq La Hu Hl Su Sl.
  pose proof (high_in_order o u Hu Su) as Ou. pose proof (low_in_order o l Hl Sl) as Ol.
  assert (Fb : Forall (fun v => 0 <= orient o b v) u) by (destruct Ub as [v ->]; now apply in_order_first).
  assert (Fp : Forall (fun v => 0 <= orient p o v) u) by (destruct Up as [v ->]; now apply in_order_last).
  assert (Fq : Forall (fun v => 0 <= orient o q v) l) by (destruct Lq as [v ->]; now apply in_order_first).
  assert (Fa : Forall (fun v => 0 <= orient a o v) l) by (destruct La as [v ->]; now apply in_order_last).
  assert (Ip : In p u) by (destruct Up as [v ->]; apply in_or_app; right; now left).
  assert (Ib : In b u) by (destruct Ub as [v ->]; now left).
  assert (Iq : In q l) by (destruct Lq as [v ->]; now left).
  assert (Ia : In a l) by (destruct La as [v ->]; apply in_or_app; right; now left).
  assert (B : b = p \/ snd o < snd b \/ (snd b = snd o /\ fst o < fst b)).
  { destruct Ub as [[| c v] ->]; [left; destruct Ip as [E | []]; exact E | right].
    destruct Su as [S _]. inversion Hu as [| ? ? B H']; subst. inversion H' as [| ? ? C _]; subst.
    now apply (rising_start o b c). }
  pose proof (proj1 (Forall_forall _ _) Hu) as Hu'. pose proof (proj1 (Forall_forall _ _) Hl) as Hl'.
  pose proof (proj1 (Forall_forall _ _) Fb p Ip) as Obp. pose proof (proj1 (Forall_forall _ _) Fq a Ia) as Oqa.
  pose proof (Hu' p Ip) as Yp. pose proof (Hu' b Ib) as Yb. pose proof (Hl' q Iq) as Yq. pose proof (Hl' a Ia) as Ya.
  simpl in Obp, Oqa, Yp, Yb, Yq, Ya.
  assert (Z : forall x, 0 <= orient o x o) by (intros; unfold orient; lra).
  assert (Z' : forall x, 0 <= orient x o o) by (intros; unfold orient; lra).
  assert (D1 : forall z, fan o u z -> ~ fan o l z).
  { intros z F G. pose proof (fan_high o u z Hu F). pose proof (fan_low o l z Hl G). lra. }
  assert (D2 : forall z, fan o u z -> ~ triangle o p q z).
  { intros z F [G _]. pose proof (fan_side p o o u z (Z' p) Fp F). unfold orient in *. lra. }
  assert (D3 : forall z, fan o u z -> ~ triangle o a b z).
  { intros z F [_ [_ G]]. pose proof (fan_side o b o u z (Z b) Fb F). unfold orient in *. lra. }
  assert (D4 : forall z, fan o l z -> ~ triangle o p q z).
  { intros z F [_ [_ G]]. pose proof (fan_side o q o l z (Z q) Fq F). unfold orient in *. lra. }
  assert (D5 : forall z, fan o l z -> ~ triangle o a b z).
  { intros z F [G _]. pose proof (fan_side a o o l z (Z' a) Fa F). unfold orient in *. lra. }
  assert (D6 : forall z, triangle o p q z -> ~ triangle o a b z).
  { intros z [P [_ Q]] [A [_ C]].
    assert (Q' : 0 < orient o z q) by (unfold orient in *; lra).
    assert (C' : 0 < orient o z b) by (unfold orient in *; lra).
    destruct (Rle_dec (snd o) (snd z)) as [Y | Y].
    - destruct B as [-> | [B | [B B']]].
      + unfold orient in *. lra.
      + pose proof (orient_levels o p z b) as E. replace (orient o p b) with (- orient o b p) in E by (unfold orient; ring).
        assert (0 < (snd b - snd o) * orient o p z) by (apply Rmult_lt_0_compat; lra).
        assert (0 <= (snd p - snd o) * orient o z b) by (apply Rmult_le_pos; lra).
        assert (0 <= (snd z - snd o) * orient o b p) by (apply Rmult_le_pos; lra). lra.
      + clear - B B' C' Y. unfold orient in C'. rewrite B in C'. nra.
    - pose proof (orient_levels o a z q) as E. replace (orient o a q) with (- orient o q a) in E by (unfold orient; ring).
      assert (0 < (snd o - snd q) * orient o a z) by (apply Rmult_lt_0_compat; lra).
      assert (0 < (snd o - snd a) * orient o z q) by (apply Rmult_lt_0_compat; lra).
      assert (0 <= (snd o - snd z) * orient o q a) by (apply Rmult_le_pos; lra). lra. }
  apply (inner_union (fun z => fan o u z \/ fan o l z) (fun z => triangle o p q z \/ triangle o a b z)).
  - intros z [F | F] [G | G]; [now apply (D2 z) | now apply (D3 z) | now apply (D4 z) | now apply (D5 z)].
  - tauto.
  - tauto.
  - apply (inner_union (fan o u) (fan o l)); [exact D1 | tauto | tauto | now apply fan_inner | now apply fan_inner].
  - apply (inner_union (triangle o p q) (triangle o a b)); [exact D6 | tauto | tauto | |]; apply triangle_inner.
Qed.

(* Any closed chain that goes left round o and rises once. *)
Lemma rotate o z l : left_round o (z :: l ++ [z]) -> crossings o (z :: l ++ [z]) = 1%nat ->
  exists u w b p q a,
    ((exists v, u = b :: v) /\ (exists v, u = v ++ [p]) /\ (exists v, w = q :: v) /\ (exists v, w = v ++ [a])) /\
    Forall (fun v => snd o <= snd v) u /\ Forall (fun v => snd v < snd o) w /\ left_round o u /\ left_round o w /\
    0 < orient o p q /\ 0 < orient o a b /\ (forall x, In x (u ++ w) -> In x (z :: l)) /\
    fan_area2 o (z :: l ++ [z]) / 2 = fan_area2 o u / 2 + fan_area2 o w / 2 + (orient o p q / 2 + orient o a b / 2) /\
    (forall x, (fan o u x \/ fan o w x) \/ (triangle o p q x \/ triangle o a b x) -> fan o (z :: l ++ [z]) x).
Proof.
  set (c := z :: l ++ [z]). intros S H. destruct (find_rise o c H) as [k [a [b [m [E [Y [C1 C2]]]]]]].
  assert (K : exists k', k ++ [a] = z :: k').
  { destruct k as [| d k]; simpl in *; inversion E; subst; eexists; reflexivity. }
  assert (M : exists m', b :: m = m' ++ [z]).
  { destruct (exists_last (l := b :: m)) as [m' [y Ey]]; [easy |]. exists m'. rewrite Ey. f_equal. f_equal.
    assert (X : c = (k ++ a :: m') ++ [y]) by (rewrite E, Ey, <- app_assoc; reflexivity).
    change c with ((z :: l) ++ [z]) in X. apply app_inj_tail in X. symmetry. apply X. }
  destruct K as [k' K]. destruct M as [m' M].
  assert (Sp : left_round o (k ++ [a]) /\ 0 < orient o a b /\ left_round o (b :: m)).
  { unfold left_round in *. rewrite E in S. apply steps_app in S. destruct S as [S1 [S2 S3]]. tauto. }
  destruct Sp as [S1 [Oab S2]].
  (* the chain from b to a *)
  set (r := m' ++ z :: k').
  assert (Cr : crossings o r = 0%nat).
  { unfold r. rewrite crossings_app, <- M, <- K. lia. }
  assert (Sr : left_round o r).
  { unfold r, left_round. apply (proj2 (steps_app _ _ _ _)). rewrite <- M, <- K. now split. }
  assert (Ar : fan_area2 o c = fan_area2 o r + orient o a b).
  { rewrite E, (area_app o k a). unfold r. rewrite (area_app o m' z), <- M, <- K. simpl. ring. }
  assert (Rr : forall x, fan o r x \/ triangle o a b x -> fan o c x).
  { intros x. rewrite E, (fan_app o k a). unfold r. rewrite (fan_app o m' z), <- M, <- K. simpl. tauto. }
  assert (Br : exists v, r = b :: v).
  { unfold r. destruct m' as [| d m']; simpl in M; inversion M; subst; eexists; reflexivity. }
  assert (Er : exists v, r = v ++ [a]).
  { unfold r. rewrite <- K. exists (m' ++ k). now rewrite app_assoc. }
  assert (Ir : forall x, In x r -> In x (z :: l)).
  { intros x I. assert (J : In x c).
    { rewrite E. change (a :: b :: m) with ([a] ++ b :: m). rewrite app_assoc, K, M. unfold r in I.
      apply in_app_or in I. rewrite in_app_iff. destruct I as [I | I]; [right; apply in_or_app; now left | now left]. }
    unfold c in J. destruct J as [J | J]; [now left |]. apply in_app_or in J.
    destruct J as [J | [J | []]]; [now right | now left]. }
  destruct (high_then_low o r Cr) as [u [w [Eu [U W]]]].
  destruct u as [| b' u0] eqn:Du.
  { exfalso. destruct Br as [v Br]. rewrite Br in Eu. simpl in Eu. subst w. inversion W; subst. lra. }
  rewrite <- Du in *.
  destruct (exists_last (l := u)) as [u' [p Ep]]; [rewrite Du; easy |].
  destruct w as [| q w0] eqn:Dw.
  { exfalso. rewrite app_nil_r in Eu. destruct Er as [v Er]. rewrite Eu in Er. rewrite Er in U.
    apply Forall_app in U. destruct U as [_ U]. inversion U; subst. lra. }
  rewrite <- Dw in *.
  assert (Ew : exists v, w = v ++ [a]).
  { destruct (exists_last (l := w)) as [w' [y Ey]]; [rewrite Dw; easy |]. exists w'. rewrite Ey. f_equal. f_equal.
    destruct Er as [v Er]. rewrite Eu, Ey, app_assoc in Er. apply app_inj_tail in Er. apply Er. }
  assert (Eb : b' = b). { destruct Br as [v Br]. rewrite Br, Du in Eu. now inversion Eu. }
  subst b'.
  assert (Sj : left_round o u /\ 0 < orient o p q /\ left_round o w).
  { unfold left_round in *. rewrite Eu, Ep, Dw, <- app_assoc in Sr. simpl app in Sr. apply steps_app in Sr.
    destruct Sr as [R1 [R2 R3]]. rewrite Ep, Dw. tauto. }
  destruct Sj as [Su [Opq Sw]].
  exists u, w, b, p, q, a.
  split; [split; [now exists u0 | split; [now exists u' | split; [now exists w0 | exact Ew]]] |].
  split; [exact U |]. split; [exact W |]. split; [exact Su |]. split; [exact Sw |]. split; [exact Opq |].
  split; [exact Oab |]. split; [intros x I; apply Ir; now rewrite Eu |].
  assert (Er2 : r = u' ++ p :: (q :: w0)) by (rewrite Eu, Ep, Dw, <- app_assoc; reflexivity). split.
  - rewrite Ar, Er2, (area_app o u' p), <- Ep. change (fan_area2 o (p :: q :: w0)) with (orient o p q + fan_area2 o (q :: w0)).
    rewrite <- Dw. field.
  - intros x X. apply Rr. rewrite Er2, (fan_app o u' p), <- Ep.
    change (fan o (p :: q :: w0) x) with (triangle o p q x \/ fan o (q :: w0) x). rewrite <- Dw. tauto.
Qed.

Theorem star_inner o z l : left_round o (z :: l ++ [z]) -> crossings o (z :: l ++ [z]) = 1%nat ->
  inner_ge (fan o (z :: l ++ [z])) (fan_area2 o (z :: l ++ [z]) / 2).
Proof.
  intros S H. destruct (rotate o z l S H) as [u [w [b [p [q [a [[X1 [X2 [X3 X4]]] [U [W [Su [Sw [_ [_ [_ [A F]]]]]]]]]]]]]]].
  rewrite A. apply (inner_subset (fun x => (fan o u x \/ fan o w x) \/ (triangle o p q x \/ triangle o a b x)) _ _ _ F
    (Rle_refl _)). now apply round_inner.
Qed.

(* o is between the points where pq and ab cross its level. *)
Lemma level_point o p q : snd q < snd o <= snd p -> exists t, 0 <= t <= 1 /\ snd (mix t p q) = snd o /\
  (snd p - snd q) * (fst o - fst (mix t p q)) = orient o p q.
Proof.
  intros Y. exists ((snd p - snd o) / (snd p - snd q)). split; [| split].
  - split; [apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat; lra] |].
    apply (Rmult_le_reg_r (snd p - snd q)); [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
  - unfold mix. simpl. field. lra.
  - unfold mix, orient. simpl. field. lra.
Qed.

Lemma star_centre (C : point -> Prop) o z l : (forall x y t, 0 <= t <= 1 -> C x -> C y -> C (mix t x y)) ->
  (forall x, In x (z :: l) -> C x) -> left_round o (z :: l ++ [z]) -> crossings o (z :: l ++ [z]) = 1%nat -> C o.
Proof.
  intros Cv V S H. destruct (rotate o z l S H) as [u [w [b [p [q [a [[[v1 X1] [[v2 X2] [[v3 X3] [v4 X4]]]] [U [W [_ [_ [Opq [Oab [I _]]]]]]]]]]]]]].
  assert (Ip : In p u) by (rewrite X2; apply in_or_app; right; now left). assert (Ib : In b u) by (rewrite X1; now left).
  assert (Iq : In q w) by (rewrite X3; now left). assert (Ia : In a w) by (rewrite X4; apply in_or_app; right; now left).
  rewrite Forall_forall in U, W. pose proof (U p Ip). pose proof (U b Ib). pose proof (W q Iq). pose proof (W a Ia).
  simpl in *.
  assert (In_ : forall x, In x u \/ In x w -> C x) by (intros x J; apply V, I, in_or_app, J).
  destruct (level_point o p q) as [s [Hs [Es Ls]]]; [lra |]. destruct (level_point o b a) as [t [Ht [Et Lt]]]; [lra |].
  set (d := mix s p q) in *. set (e := mix t b a) in *.
  assert (Cd : C d) by (apply Cv; [exact Hs | |]; apply In_; tauto).
  assert (Ce : C e) by (apply Cv; [exact Ht | |]; apply In_; tauto).
  assert (Ld : fst d < fst o) by nra.
  assert (Le : fst o < fst e). { assert (orient o b a < 0) by (unfold orient in *; lra). nra. }
  replace o with (mix ((fst o - fst d) / (fst e - fst d)) d e).
  - apply Cv; [| exact Cd | exact Ce]. split; [apply Rlt_le, Rdiv_lt_0_compat; lra |].
    apply (Rmult_le_reg_r (fst e - fst d)); [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
  - destruct o as [x y]. unfold mix. simpl in *. rewrite Es, Et. f_equal; field; lra.
Qed.

(* V, area: the polygons in doubles. *)
Theorem star_polygon_inner N B W i o z l : left_round o (z :: l ++ [z]) -> crossings o (z :: l ++ [z]) = 1%nat ->
  (forall v, In v (z :: l) -> inside v W /\ int N B i v) ->
  inner_ge (int_in N B W i) (fan_area2 o (z :: l ++ [z]) / 2).
Proof.
  intros S H V. eapply inner_subset; [| apply Rle_refl | now apply star_inner].
  assert (Vx : forall v, In v (z :: l) -> int_in N B W i v) by (intros v I; split; now apply V).
  assert (Cv : forall x y t, 0 <= t <= 1 -> int_in N B W i x -> int_in N B W i y -> int_in N B W i (mix t x y))
    by (intros x y t; apply int_in_convex).
  intros x. apply fan_in_convex; [exact Cv | now apply (star_centre _ o z l) |].
  intros v I. apply Vx. change (z :: l ++ [z]) with ((z :: l) ++ [z]) in I. apply in_app_or in I.
  destruct I as [I | [<- | []]]; [exact I | now left].
Qed.

(* What the code adds up for cell i: nothing, or a lower bound of what either rung computes for a polygon with vertices
   in the cell and in the window. Then the rest bounds the undetermined area. *)
Definition counted (N : nat) (B : sites) (W : rect) (i : nat) (a : R) : Prop :=
  a <= 0 \/
  (exists P, counterclockwise P /\ (forall v, In v P -> inside v W /\ int N B i v) /\ a <= polygon_area2 P / 2) \/
  (exists o z l, left_round o (z :: l ++ [z]) /\ crossings o (z :: l ++ [z]) = 1%nat /\
    (forall v, In v (z :: l) -> inside v W /\ int N B i v) /\ a <= fan_area2 o (z :: l ++ [z]) / 2).

Theorem window_area N B W a : (forall i, (i < N)%nat -> counted N B W i (a i)) ->
  measure_le (fun z => inside z W /\ undetermined N B z) (area W - sum_below a N).
Proof.
  intros H. apply undetermined_area. intros i I. destruct (H i I) as [Z | [[P [C [V L]]] | [o [z [l [S [C [V L]]]]]]]].
  - now apply inner_trivial.
  - eapply inner_subset; [intros z Z; exact Z | exact L | now apply polygon_inner].
  - eapply inner_subset; [intros x X; exact X | exact L | now apply star_polygon_inner].
Qed.
